#include "tools/survey/collect.h"

#include "fusion/identity.h"
#include "tools/evaluate/read.h"
#include "tools/replay/recording.h"

#include <stdexcept>

namespace locus::survey {
namespace {

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

Collected collect(const Request& request, const Settings& settings) {
    check_numbers(request);
    std::uint64_t bad_lines = 0;
    Collector collector(request.cell_m, request.stood_site_m);
    for (std::size_t i = 0; i < request.recordings.size(); ++i) {
        evaluate::Track track;
        if (!request.poses.empty()) track = evaluate::read_estimate(poses_of(request, i));
        const auto take = [&](const Measurement& measurement, Timestamp) {
            const auto* strength = std::get_if<SignalStrength>(&measurement.observation);
            if (strength == nullptr) return;
            const radio::Reading reading{beacon_of(*strength, settings.engine.site), double{strength->rssi_dbm}};
            collector.add(reading, to_s(measurement.time), track);
        };
        bad_lines += replay::read_recording(request.recordings[i], settings, take).bad_lines;
    }
    Collected collected = collector.finish(request.heading);
    collected.bad_lines = bad_lines;
    return collected;
}

} // namespace locus::survey
