// Measurements out of NLink frames: which frame gives which stands in nlink.h.
#include "drivers/uwb/nlink.h"

#include "drivers/frame_decoder.h"
#include "drivers/uwb/nlink_messages.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace nlink {
namespace {

/// No radio receives 0 dBm: the unit had nothing to say.
float power_dbm(std::uint8_t wire) { return wire == 0 ? unknown_f : -0.5f * static_cast<float>(wire); }

/// Units that may move: a `node` has no fixed part.
bool carried(Role role) { return role == Role::tag || role == Role::node; }

template <class Numbers>
bool all_finite(const Numbers& numbers) {
    return std::ranges::all_of(numbers, [](float value) { return std::isfinite(value); });
}

/// One frame's measurements, all of one time.
class Give {
  public:
    Give(const NlinkSettings& settings, Timestamp time, MeasurementSink& sink)
        : settings_(settings), time_(time), sink_(sink) {}

    void operator()(const AnchorFrame& frame) const {
        for (const AnchorFrame::Tag& tag : frame.tags)
            for (std::uint32_t i = 0; i < tag.distance_cm.size() && tag.role == Role::tag; ++i)
                range(i, tag.id, tag.distance_cm[i] * 1e-2);
    }

    void operator()(const TagFrame& frame) const {
        for (std::uint32_t i = 0; i < frame.distance_mm.size(); ++i)
            range(i, frame.sender.id, frame.distance_mm[i] * 1e-3);
        imu(frame.sender, frame.motion);
    }

    void operator()(const RangesFrame& frame) const {
        for (const RangesFrame::Node& node : frame.nodes) pair(frame.sender, node);
        if (frame.mark == Mark::node_frame2 && carried(frame.sender.role)) imu(frame.sender, frame.motion);
    }

    void operator()(const ConsoleFrame& frame) const {
        auto next = frame.ranges.begin();
        for (const ConsoleFrame::Tag& tag : frame.tags)
            for (const auto end = next + tag.ranges; next != end; ++next)
                range(next->anchor, tag.id, next->distance_mm * 1e-3);
    }

    template <class WithoutMeasurements>
    void operator()(const WithoutMeasurements&) const {}

  private:
    const NlinkSettings& settings_;
    Timestamp time_;
    MeasurementSink& sink_;

    Address anchor(std::uint64_t id) const { return address(id + static_cast<unsigned>(settings_.anchor_offset)); }
    Address tag(std::uint64_t id) const { return address(id + static_cast<unsigned>(settings_.tag_offset)); }

    bool measured(double range_m) const {
        if (range_m < 0) sink_.refuse(Refusal::out_of_range);
        return range_m > 0;
    }

    void range(std::uint32_t anchor_id, std::uint32_t tag_id, double range_m, float rx_power_dbm = unknown_f,
               float first_path_power_dbm = unknown_f) const {
        if (!measured(range_m)) return;
        sink_.accept(time_, Range{anchor(anchor_id), tag(tag_id), range_m, unknown_f, rx_power_dbm,
                                  first_path_power_dbm, LineOfSight::unknown});
    }

    void pair(const Sender& sender, const RangesFrame::Node& node) const {
        const double range_m = node.distance_mm * 1e-3;
        if (sender.role == Role::anchor && carried(node.role))
            range(sender.id, node.id, range_m, power_dbm(node.received_power), power_dbm(node.first_path_power));
        else if (carried(sender.role) && node.role == Role::anchor)
            range(node.id, sender.id, range_m, power_dbm(node.received_power), power_dbm(node.first_path_power));
        else if (carried(sender.role) && carried(node.role) && measured(range_m))
            sink_.accept(time_, PeerRange{tag(sender.id), tag(node.id), range_m, unknown_f});
    }

    void imu(const Sender& sender, const Motion& motion) const {
        const auto &force = motion.specific_force_mps2, &rate = motion.angular_rate_radps;
        if (force == std::array<float, 3>{} && rate == std::array<float, 3>{}) return;
        if (!all_finite(force) || !all_finite(rate)) return sink_.refuse(Refusal::out_of_range);
        ImuSample sample;
        sample.tag = tag(sender.id);
        std::ranges::copy(force, sample.specific_force_mps2.begin());
        std::ranges::copy(rate, sample.angular_rate_radps.begin());
        sink_.accept(time_, sample);
    }
};

class Nlink : public FrameDecoder<Format> {
  public:
    explicit Nlink(const NlinkSettings& settings) : settings_(settings) {}

  private:
    NlinkSettings settings_;

    void frame(const Frame& frame, MeasurementSink& sink) override {
        const auto message = parse(frame.bytes);
        if (!message) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        std::visit(Give{settings_, frame.begun, sink}, *message);
    }
};

} // namespace
} // namespace nlink

std::unique_ptr<Decoder> make_nlink(const void* settings) {
    return std::make_unique<nlink::Nlink>(*static_cast<const NlinkSettings*>(settings));
}

} // namespace locus::uwb
