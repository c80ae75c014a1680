#include "tools/survey/live.h"

#include "config/address.h"
#include "tools/client/fields.h"
#include "tools/client/watching.h"
#include "tools/interrupt.h"

#include <algorithm>
#include <chrono>

namespace locus::survey {
namespace {

using std::chrono::steady_clock;

/// The sensors whose poses say where a radio is only by what the map is to be made of.
bool is_by_radio(const nlohmann::json& kinds) {
    const auto tells_nothing = [](const nlohmann::json& kind) { return kind == "SIGNAL_STRENGTH" || kind == "IMU"; };
    return std::ranges::all_of(kinds, tells_nothing);
}

} // namespace

void LiveSurvey::take(const tools::Message& message) {
    if (message.class_name == "POSE") take_pose(message);
    if (message.class_name == "READING") take_reading(message);
}

void LiveSurvey::take_pose(const tools::Message& message) {
    const auto time_s = tools::number(message.fields, "time");
    const auto place = tools::vector3(message.fields, "position_site_m");
    if (!time_s.has_value() || !place.has_value()) return;
    if (is_by_radio(tools::list(message.fields, "kinds_used"))) {
        ++progress_.poses_by_radio;
        return;
    }
    evaluate::Track& track = tracks_[tools::text(message.fields, "target")];
    if (!track.empty() && time_s.value() <= track.back().time_s) return;
    track.push_back({time_s.value(), Eigen::Vector3d(place.value()[0], place.value()[1], place.value()[2])});
    ++progress_.poses;
}

void LiveSurvey::take_reading(const tools::Message& message) {
    const auto time_s = tools::number(message.fields, "time"), rssi_dbm = tools::number(message.fields, "rssi_dbm");
    const auto beacon = config::parse_address(tools::text(message.fields, "beacon"));
    if (!time_s.has_value() || !rssi_dbm.has_value() || !beacon.has_value()) return;
    heard_.push_back({tools::text(message.fields, "target"), time_s.value(), {beacon.value(), rssi_dbm.value()}});
    ++progress_.readings;
}

Collected LiveSurvey::finish() {
    Collector collector(request_.cell_m, request_.stood_site_m);
    for (const Heard& each : heard_) collector.add(each.reading, each.time_s, tracks_[each.target]);
    return collector.finish(request_.heading);
}

Collected survey_live(tools::Client& client, const LiveRequest& request,
                      const std::function<void(const LiveProgress&)>& tell) {
    using namespace std::chrono_literals;
    tools::catch_interrupts();
    LiveSurvey survey(request);
    tools::start_watching(client, {request.targets, 10, true});
    const auto end = request.seconds > 0 ? tools::deadline_in(request.seconds) : tools::Deadline::max();
    auto next = steady_clock::now() + 1s;
    while (!tools::interrupted() && steady_clock::now() < end) {
        if (const auto message = client.receive(std::min({end, next, steady_clock::now() + 200ms})))
            survey.take(message.value());
        if (steady_clock::now() < next) continue;
        tell(survey.progress());
        next = steady_clock::now() + 1s;
    }
    return survey.finish();
}

} // namespace locus::survey
