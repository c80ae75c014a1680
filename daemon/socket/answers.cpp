#include "daemon/socket/answers.h"

#include "daemon/socket/diagnose.h"
#include "daemon/socket/json_text.h"
#include "daemon/socket/pose_line.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace locus {
namespace {

using nlohmann::ordered_json;

constexpr std::array<std::string_view, 10> source_kind_names{"anchor",  "camera", "satellite", "beacon", "imu",
                                                             "vehicle", "input",  "tag",       "base",   "heading"};
static_assert(source_kind_names.size() == static_cast<std::size_t>(SourceKind::heading) + 1);

/// One line; names that are not UTF-8 are mended, never thrown over.
std::string line(const ordered_json& object) {
    return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

void put_finite(ordered_json& object, const char* key, double value) {
    if (std::isfinite(value)) object[key] = value;
}

/// Nothing when `time` is not known.
void put_age(ordered_json& object, const char* key, Timestamp time, Timestamp now) {
    if (time != Timestamp{}) object[key] = to_s(now - time);
}

ordered_json counters_json(const AidCounters& counters) {
    return {{"received", counters.received},
            {"used", counters.used},
            {"refused", counters.refused},
            {"late", counters.late}};
}

/// null where a coordinate is not known.
ordered_json known_coordinates(const Vec3f& site_m) {
    ordered_json list = ordered_json::array();
    for (const float coordinate_m : site_m)
        list.push_back(std::isfinite(coordinate_m) ? ordered_json(coordinate_m) : ordered_json());
    return list;
}

ordered_json health_json(const AnchorReport& health, Timestamp now) {
    ordered_json object{{"state", anchor_state_name(health.state)}, {"sentence", anchor_state_sentence(health.state)}};
    put_age(object, "since_s", health.since, now);
    put_finite(object, "residual_m", health.residual_m);
    put_finite(object, "residual_sigma_m", health.residual_sigma_m);
    object["blocked_share"] = health.blocked_share;
    if (!std::isfinite(health.moved_m)) return object;
    object["moved_m"] = health.moved_m;
    object["stands_site_m"] = known_coordinates(health.stands_site_m);
    object["stands_covariance_m2"] = health.stands_covariance_m2;
    return object;
}

ordered_json source_json(const AidStatus& source, const Roster& roster, Timestamp now) {
    const Verdict& verdict = source.last_verdict;
    ordered_json object{{"kind", source_kind_names[static_cast<std::size_t>(source.kind)]},
                        {"name", roster.names.source(source.kind, source.source)},
                        {"address", address_text(source.source)}};
    if (source.input < roster.inputs.size()) object["input"] = roster.inputs[source.input].name;
    object["used"] = verdict.reason == Exclusion::none;
    object["reason"] = exclusion_name(verdict.reason);
    object["sentence"] = exclusion_sentence(verdict.reason);
    if (verdict.carrier != CarrierUse::none)
        object["carrier"] = carrier_texts[static_cast<std::size_t>(verdict.carrier)].name;
    if (source.last_time != Timestamp{}) put_finite(object, "observation", source.last_observation);
    put_finite(object, "innovation", verdict.innovation);
    put_finite(object, "innovation_sigma", verdict.innovation_sigma);
    put_finite(object, "test_ratio", verdict.test_ratio);
    put_finite(object, "rate_hz", source.rate_hz);
    put_finite(object, "delay_s", source.delay_s);
    put_age(object, "age_s", source.last_time, now);
    put_age(object, "last_used_age_s", source.last_used_time, now);
    if (source.last_target != no_address) object["last_target"] = roster.names.target(source.last_target);
    object["counters"] = counters_json(source.counters);
    if (source.kind == SourceKind::anchor) object["health"] = health_json(source.health, now);
    return object;
}

ordered_json refused_json(const InputStatus& status) {
    ordered_json object = ordered_json::object();
    for (std::size_t reason = 0; reason < refusal_count; ++reason)
        if (const auto count = status.refused[reason].load()) object[std::string{refusal_names[reason]}] = count;
    return object;
}

void put_rates(ordered_json& object, const InputRate& rate) {
    object["bytes_per_s"] = rate.bytes;
    object["packets_per_s"] = rate.packets;
    object["frames_per_s"] = rate.frames;
    object["measurements_per_s"] = rate.measurements;
}

/// What went wrong last, also when all is well again.
void put_last_error(ordered_json& object, const InputStatus& status, Timestamp now) {
    const std::string error = status.last_error.get();
    if (error.empty()) return;
    object["last_error"] = error;
    put_age(object, "last_error_age_s", timestamp_from_ns(status.last_error_ns), now);
}

ordered_json input_json(const InputEntry& input, const InputRates& rates, Timestamp now) {
    ordered_json object{{"name", input.name}, {"transport", input.transport}, {"decoder", input.decoder}};
    object["state"] = input.status ? name_of(input.status->state) : "disabled";
    if (!input.status) return object;
    const InputStatus& status = *input.status;
    object["error"] = status.trouble.get();
    if (const std::string doing = status.doing.get(); !doing.empty()) object["doing"] = doing;
    put_last_error(object, status, now);
    object["bytes"] = status.bytes.load();
    object["packets"] = status.packets.load();
    object["frames"] = status.frames.load();
    object["measurements"] = status.measurements.load();
    object["refused"] = refused_json(status);
    object["resyncs"] = status.resyncs.load();
    object["reconnects"] = status.reconnects.load();
    object["ring_dropped"] = status.ring_dropped.load();
    object["kernel_dropped"] = status.kernel_dropped.load();
    object["wire_errors"] = status.wire_errors.load();
    if (const auto rate = rates.rate(status, now)) put_rates(object, *rate);
    put_age(object, "age_s", timestamp_from_ns(status.last_packet_ns), now);
    return object;
}

ordered_json target_json(Address address, const TargetView& view, const Roster& roster, Timestamp now) {
    const Pose& pose = view.pose;
    const bool has_pose = is_publishable(pose);
    ordered_json object{{"name", roster.names.target(address)}, {"address", address_text(address)}};
    if (pose.estimator < estimator_table().size()) object["estimator"] = estimator_table()[pose.estimator].name;
    object["has_pose"] = has_pose;
    object["missing"] = missing_sentence(pose.estimate.missing);
    if (has_pose) {
        object["time"] = to_s(pose.estimate.time);
        put_age(object, "age_s", pose.estimate.time, now);
        object["position_site_m"] = pose.estimate.position_site_m;
        put_finite(object, "horizontal_error_95_m", pose.horizontal_error_95_m);
    }
    object["reset_count"] = view.reset_count();
    return object;
}

ordered_json engine_json(const EngineCounters& counters) {
    return {{"received", counters.received},
            {"late", counters.late},
            {"refused", counters.refused},
            {"rolled_back", counters.rolled_back}};
}

} // namespace

std::string_view release() { return LOCUS_RELEASE; }

std::string version_line(const Roster& roster) {
    return line({{"class", "VERSION"},
                 {"release", release()},
                 {"protocol_major", protocol_major},
                 {"protocol_minor", protocol_minor},
                 {"site", roster.site},
                 {"rate_hz", roster.rate_hz}});
}

std::string watch_line(const Watch& watch) {
    ordered_json object{{"class", "WATCH"}, {"enable", watch.enable}, {"poses", watch.poses}};
    if (watch.smoothed) object["smoothed"] = true;
    if (watch.readings) object["readings"] = true;
    if (watch.rate_hz > 0) object["rate_hz"] = watch.rate_hz;
    if (!watch.targets.empty()) object["targets"] = watch.targets;
    return line(object);
}

std::string sources_line(const Picture& picture, const Roster& roster, const InputRates& rates, Timestamp now) {
    ordered_json sources = ordered_json::array(), inputs = ordered_json::array();
    for (const AidStatus& source : picture.sources())
        if (source.source != no_address) sources.push_back(source_json(source, roster, now));
    for (const InputEntry& input : roster.inputs) inputs.push_back(input_json(input, rates, now));
    return line({{"class", "SOURCES"}, {"sources", std::move(sources)}, {"inputs", std::move(inputs)}});
}

std::string targets_line(const Picture& picture, const Roster& roster, Timestamp now) {
    ordered_json targets = ordered_json::array();
    for (const auto& [address, view] : picture.targets()) targets.push_back(target_json(address, view, roster, now));
    return line({{"class", "TARGETS"}, {"targets", std::move(targets)}});
}

std::string status_line(const Picture& picture, const Roster& roster, std::size_t clients, Timestamp now) {
    const TickItem& tick = picture.tick();
    ordered_json object{{"class", "STATUS"},
                        {"working", is_working(picture)},
                        {"missing", diagnose(picture, roster)},
                        {"uptime_s", to_s(now - roster.started)},
                        {"rate_hz", roster.rate_hz},
                        {"ticks", tick.ticks},
                        {"overruns", tick.overruns}};
    if (const auto late = picture.lateness())
        object["tick_late_us"] = {{"p50", late->p50_us}, {"p99", late->p99_us}, {"max", late->max_us}};
    object["clients"] = clients;
    object["config"] = roster.config;
    object["engine"] = engine_json(tick.engine);
    object["poses_dropped"] = tick.poses_dropped;
    object["memory_locked"] = roster.memory_locked;
    object["realtime"] = tick.realtime;
    object["version"] = release();
    return line(object);
}

std::string poll_lines(const Picture& picture, const Roster& roster) {
    std::string lines;
    std::size_t poses = 0;
    for (const auto& [address, view] : picture.targets()) {
        if (!is_publishable(view.pose)) continue;
        lines += open_pose_line(view.pose, roster.names, view.reset_count()) + "}\n";
        ++poses;
    }
    return lines + line({{"class", "POLL"}, {"poses", poses}});
}

std::string view_line(const std::string& camera, const std::string& jpeg_base64) {
    return line({{"class", "VIEW"}, {"camera", camera}, {"jpeg_base64", jpeg_base64}});
}

std::string reload_line(bool ok, const std::vector<std::string>& problems) {
    return line({{"class", "RELOAD"}, {"ok", ok}, {"problems", problems}});
}

std::string error_line(std::string_view message) { return line({{"class", "ERROR"}, {"message", message}}); }

} // namespace locus
