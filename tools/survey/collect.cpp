#include "tools/survey/collect.h"

#include "fusion/radio/survey.h"
#include "tools/evaluate/read.h"
#include "tools/replay/recording.h"

#include <algorithm>
#include <stdexcept>

namespace locus::survey {
namespace {

/// Between poses farther apart nobody knows which way was taken.
constexpr double longest_gap_s = 1;

radio::Reading reading_of(const SignalStrength& strength, const Site& site) {
    const bool heard_at_anchor = site.find_anchor(strength.receiver) != nullptr;
    return {heard_at_anchor ? strength.receiver : strength.transmitter, double{strength.rssi_dbm}};
}

const std::string& poses_of(const Request& request, std::size_t recording) {
    return request.poses.size() == 1 ? request.poses.front() : request.poses[recording];
}

void check_numbers(const Request& request) {
    if (request.poses.empty() == !request.stood_site_m.has_value())
        throw std::runtime_error("say where it was heard: by --poses, or by --at for somebody who stood");
    if (request.poses.size() > 1 && request.poses.size() != request.recordings.size())
        throw std::runtime_error("there must be one --poses for all recordings, or one for each");
}

} // namespace

std::optional<Vec3> place_at(const evaluate::Track& track, double time_s) {
    const auto after = std::ranges::upper_bound(track, time_s, {}, &evaluate::TrackPoint::time_s);
    if (after == track.begin() || after == track.end()) return std::nullopt;
    const auto before = after - 1;
    const double gap_s = after->time_s - before->time_s;
    if (gap_s > longest_gap_s) return std::nullopt;
    const Eigen::Vector3d place =
        before->position_m + (time_s - before->time_s) / gap_s * (after->position_m - before->position_m);
    return Vec3{place.x(), place.y(), place.z()};
}

Collected collect(const Request& request, const Settings& settings) {
    check_numbers(request);
    Collected collected;
    radio::Survey survey(request.cell_m);
    for (std::size_t i = 0; i < request.recordings.size(); ++i) {
        evaluate::Track track;
        if (!request.poses.empty()) track = evaluate::read_estimate(poses_of(request, i));
        const auto take = [&](const Measurement& measurement, Timestamp) {
            const auto* strength = std::get_if<SignalStrength>(&measurement.observation);
            if (strength == nullptr) return;
            const auto place =
                request.stood_site_m.has_value() ? request.stood_site_m : place_at(track, to_s(measurement.time));
            if (!place.has_value()) {
                ++collected.unplaced;
                return;
            }
            survey.add(reading_of(*strength, settings.engine.site), place.value());
            ++collected.readings;
        };
        collected.bad_lines += replay::read_recording(request.recordings[i], settings, take).bad_lines;
    }
    collected.map = survey.map();
    collected.map.site = request.site;
    collected.map.date = request.date;
    collected.map.device = request.device;
    return collected;
}

} // namespace locus::survey
