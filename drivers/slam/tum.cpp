// TUM lines: grammar in tum.h.
#include "drivers/slam/tum.h"

#include "drivers/device_clock.h"
#include "drivers/line_decoder.h"
#include "drivers/slam/segments.h"
#include "drivers/wire/bytes.h"
#include "drivers/wire/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace locus::slam {
namespace {

/// Two decimals of each of its four numbers, rounded, change a quaternion's length by at most this.
constexpr double unit_tolerance = 0.01;
constexpr double largest_time_s = 4e9; ///< since 1970 until 2096; ORB-SLAM3's EuRoC files have nanoseconds
constexpr double farthest = 1e6;       ///< in the SLAM's unit, which is metres or the depth of its first view

/// A frame is as late as tracking it takes, which is less than 0.1 s in real time and some times that when the machine
/// is busy; one that is this late for long is not.
constexpr DeviceClock::Limits slam_clock{.jump_s = 0.25, .patience = std::chrono::seconds{5}};

bool skip_blanks(wire::Text& text) {
    bool any = false;
    while (text.literal(" ") || text.literal("\t") || text.literal(",")) any = true;
    return any;
}

/// The number, and blanks or the line's end behind it.
bool read_tum_number(wire::Text& text, double& number) {
    return text.number(number) && (skip_blanks(text) || text.done());
}

double length(const std::array<double, 4>& q) {
    return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

class Tum : public LineDecoder {
  public:
    explicit Tum(const TumSettings& settings)
        : by_arrival_{settings.stamps == "arrival"}, segments_{duration_from_s(settings.gap_s)} {
        odometry_.tag = settings.tag;
        odometry_.camera = settings.camera == no_address ? settings.tag : settings.camera;
    }

    /// A line that was plugged in again says nothing of the SLAM's path, and a replay would not know of it.
    void reset() override {
        LineDecoder::reset();
        clock_.reset();
    }

  private:
    bool by_arrival_;
    Segments segments_;
    DeviceClock clock_{1e-9, 64, slam_clock};
    VisualOdometry odometry_;

    void line(std::string_view text, Timestamp begun, MeasurementSink& sink) override {
        wire::Text rest{text};
        skip_blanks(rest);
        if (rest.done()) return;
        if (rest.literal("#")) return remark(rest, text, sink);
        const auto pose = parse_tum_pose(text);
        if (!pose) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        is_usable(*pose) ? give(*pose, begun, sink) : sink.refuse(Refusal::out_of_range);
    }

    /// Anybody's remark, or one of the two that are for us.
    void remark(wire::Text rest, std::string_view text, MeasurementSink& sink) {
        skip_blanks(rest);
        std::uint64_t map = 0;
        if (rest.literal("segment") && skip_blanks(rest) && rest.number(map))
            segments_.name(map);
        else if (rest.literal("lost") && (skip_blanks(rest), rest.done()))
            segments_.lose();
        else
            return;
        sink.frame(wire::bytes_of(text));
    }

    void give(const TumPose& pose, Timestamp begun, MeasurementSink& sink) {
        const Timestamp stamp = timestamp_from_s(pose.time_s);
        const auto segment = segments_.of(by_arrival_ ? begun : stamp);
        if (!segment) return sink.refuse(Refusal::out_of_range);
        odometry_.segment = *segment;
        odometry_.position_odometry = pose.position;
        odometry_.orientation_xyzw = pose.orientation_xyzw;
        for (double& part : odometry_.orientation_xyzw) part /= length(pose.orientation_xyzw);
        sink.accept(by_arrival_ ? begun : clock_.host_time(static_cast<std::uint64_t>(to_ns(stamp)), begun), odometry_);
    }
};

} // namespace

std::optional<TumPose> parse_tum_pose(std::string_view line) {
    wire::Text text{line};
    TumPose pose;
    auto& [x, y, z] = pose.position;
    auto& [qx, qy, qz, qw] = pose.orientation_xyzw;
    skip_blanks(text);
    for (double* number : {&pose.time_s, &x, &y, &z, &qx, &qy, &qz, &qw})
        if (!read_tum_number(text, *number)) return std::nullopt;
    return text.done() ? std::optional{pose} : std::nullopt;
}

bool is_usable(const TumPose& pose) {
    const auto is_near = [](double number) { return std::abs(number) <= farthest; }; // false for nan
    return std::abs(pose.time_s) < largest_time_s && std::ranges::all_of(pose.position, is_near) &&
           std::abs(length(pose.orientation_xyzw) - 1) <= unit_tolerance;
}

std::string encode(const TumPose& pose) {
    return fmt::format("{} {} {}\n", pose.time_s, fmt::join(pose.position, " "), fmt::join(pose.orientation_xyzw, " "));
}

std::unique_ptr<Decoder> make_tum(const void* settings) {
    return std::make_unique<Tum>(*static_cast<const TumSettings*>(settings));
}

} // namespace locus::slam
