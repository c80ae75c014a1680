#include "daemon/service.h"

#include "config/radio_map.h"
#include "daemon/log.h"
#include "daemon/realtime.h"
#include "drivers/clock.h"

#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <stdexcept>

namespace locus {
namespace {

constexpr int look_around_ms = 100;
constexpr Duration ready_at_the_latest = std::chrono::seconds{5};

std::string engine_text(const Settings& settings) {
    Settings only;
    only.engine = settings.engine;
    return fmt::format("{}# {} cameras\n{}", print_settings(only), settings.engine.cameras,
                       config::radio_maps_text(settings.engine.estimators));
}

/// Empty when no target is to be told; that it is known and the site anchored was checked when the settings were read.
std::optional<NmeaPlan> nmea_plan(const Settings& settings) {
    const auto& targets = settings.engine.targets;
    const auto target = std::ranges::find(targets, settings.nmea.target, &TargetSettings::name);
    if (settings.nmea.target.empty() || target == targets.end()) return std::nullopt;
    const std::optional<Wgs84Anchor>& origin = settings.engine.site.origin;
    if (!origin.has_value()) return std::nullopt;
    return NmeaPlan{settings.nmea, target->address, origin.value()};
}

} // namespace

Service::Service(Settings settings, std::string config, Listener listener, LogFile* recording)
    : settings_{std::move(settings)}, config_{std::move(config)}, started_{monotonic_now()}, recording_{recording},
      inputs_{recording}, cameras_{recording},
      fusion_{plan(std::make_unique<Engine>(settings_.engine)), output_, ticked_},
      publisher_{std::move(listener), output_, ticked_, post_, roster()} {
    publisher_thread_ = std::jthread{[this](const std::stop_token& stop) {
        name_this_thread("publisher");
        publisher_.run(stop);
    }};
    fusion_thread_ = std::jthread{[this](const std::stop_token& stop) {
        name_this_thread("fusion");
        fusion_.run(stop);
    }};
    put_in_force(settings_, nullptr);
    keep_map();
}

Service::~Service() {
    fusion_thread_.request_stop();
    publisher_thread_.request_stop();
    inputs_.stop();
    cameras_.stop();
    map_keeper_.reset();
    flush_recording();
}

/// Settings that were checked come into force; `engine` null: the one in use stays.
void Service::put_in_force(Settings settings, std::unique_ptr<Engine> engine) {
    settings_ = std::move(settings);
    const bool is_new_engine = engine != nullptr;
    if (is_new_engine) ++generation_;
    const int priority = beside_fusion(settings_.realtime.priority);
    inputs_.apply(settings_.inputs, priority);
    cameras_.apply(settings_.cameras, priority);
    schedule_thread(publisher_thread_.native_handle(), priority);
    auto next = plan(std::move(engine));
    lock();
    plan_on_its_way_ = fusion_.plans.give(next);
    auto names = roster();
    post_.rosters.give(names);
    post_.publisher.raise();
    if (is_new_engine) keep_map();
}

/// Of the settings that the engine is made of: it reads the grid that they have.
void Service::keep_map() {
    map_keeper_.reset(); // writes down what was taught
    map_keeper_ = MapKeeper::make(settings_.engine, output_.lessons, fusion_);
    if (map_keeper_) map_keeper_->start();
}

std::unique_ptr<FusionPlan> Service::plan(std::unique_ptr<Engine> engine) const {
    auto plan = std::make_unique<FusionPlan>();
    plan->engine = std::move(engine);
    inputs_.plan(plan->inputs, 0);
    cameras_.plan(plan->inputs, inputs_.size());
    plan->generation = generation_;
    plan->rate_hz = settings_.engine.fusion.rate_hz;
    plan->spin = duration_from_s(settings_.realtime.spin_s);
    plan->priority = settings_.realtime.priority;
    return plan;
}

std::unique_ptr<const Roster> Service::roster() const {
    Roster roster;
    roster.generation = generation_;
    roster.site = settings_.engine.site.name;
    roster.config = config_;
    roster.rate_hz = settings_.engine.fusion.rate_hz;
    roster.anchors = settings_.engine.site.anchors.size();
    roster.publish = settings_.publish;
    roster.nmea = nmea_plan(settings_);
    roster.names = Names{settings_};
    roster.inputs = entries(inputs_);
    for (InputEntry& camera : entries(cameras_)) roster.inputs.push_back(std::move(camera));
    roster.memory_locked = memory_locked_;
    roster.started = started_;
    return std::make_unique<const Roster>(std::move(roster));
}

void Service::lock() {
    if (!settings_.realtime.lock_memory) return;
    const bool locked = lock_memory();
    if (!locked && generation_ == 1 && !ready_)
        spdlog::warn("memory cannot be locked (LimitMEMLOCK): a tick may come late when the machine is short of it");
    memory_locked_ = locked;
}

void Service::run(const Signals& signals) {
    while (!stop_) {
        wait(signals);
        heed(signals);
        collect_retired();
        serve_reload_requests();
        report();
        flush_recording();
    }
    manager_.stopping();
}

void Service::stop() {
    stop_ = true;
    post_.main.raise();
}

void Service::wait(const Signals& signals) const {
    std::array<pollfd, 2> sources{{{signals.fd(), POLLIN, 0}, {post_.main.fd(), POLLIN, 0}}};
    ::poll(sources.data(), sources.size(), look_around_ms);
    post_.main.hush();
}

void Service::heed(const Signals& signals) {
    for (int signal = signals.next(); signal != 0; signal = signals.next()) {
        if (signal == SIGHUP) hang_up_ = true;
        if (signal == SIGUSR2) fusion_.stall();
        if (signal == SIGTERM || signal == SIGINT) stop_ = true;
    }
}

/// One plan at a time is on its way to the fusion thread: the next waits until the one before has come back.
void Service::serve_reload_requests() {
    if (!plan_on_its_way_ && std::exchange(hang_up_, false)) reload_and_log();
    for (ReloadRequest request; !plan_on_its_way_ && post_.requests.pop(request);) {
        auto problems = reload();
        const bool ok = problems.empty();
        auto answer = std::make_unique<const ReloadAnswer>(ReloadAnswer{request.client, ok, std::move(problems)});
        post_.answers.give(answer);
        post_.publisher.raise();
    }
}

void Service::collect_retired() {
    while (fusion_.retired.take()) plan_on_its_way_ = false;
}

/// Null when the engine in use is made of the same settings.
std::unique_ptr<Engine> Service::engine_if_changed(const Settings& settings) const {
    if (engine_text(settings) == engine_text(settings_)) return nullptr;
    return std::make_unique<Engine>(settings.engine);
}

std::vector<std::string> Service::reload() {
    LoadResult loaded = load_settings(config_);
    std::vector<std::string> problems;
    for (const ConfigProblem& problem : loaded.problems) problems.push_back(to_string(problem));
    if (!loaded.settings) return problems;
    if (loaded.settings->publish.socket != settings_.publish.socket)
        spdlog::warn("publish.socket comes into force at the next start; clients still connect where they did");
    manager_.reloading();
    try {
        auto engine = engine_if_changed(*loaded.settings);
        put_in_force(std::move(*loaded.settings), std::move(engine));
        set_log_level(settings_.log.level);
    } catch (const std::invalid_argument& error) {
        problems.push_back(config_ + ": " + error.what());
    }
    if (ready_) manager_.ready();
    return problems;
}

void Service::reload_and_log() {
    const auto problems = reload();
    for (const std::string& problem : problems) spdlog::error("{}", problem);
    if (problems.empty())
        spdlog::info("configuration {} read again and in force", config_);
    else
        spdlog::error("the configuration in force stays as it was");
}

void Service::report() {
    const Timestamp now = monotonic_now();
    if (!ready_ && ((inputs_.all_tried() && cameras_.all_tried()) || now - started_ > ready_at_the_latest)) {
        ready_ = true;
        manager_.ready();
        spdlog::info("ready: {}", summary());
    }
    if (!scheduling_told_ && fusion_.scheduling() != FusionLoop::Scheduling::unknown) {
        scheduling_told_ = true;
        if (settings_.realtime.priority > 0 && fusion_.scheduling() == FusionLoop::Scheduling::ordinary)
            spdlog::warn("real-time scheduling is not allowed (LimitRTPRIO): ticks may come late on a busy machine");
    }
    manager_.status(summary(), now);
    if (manager_.is_due(now) && vital_signs_.both_moved(fusion_.heartbeat(), publisher_.heartbeat())) manager_.alive();
}

void Service::flush_recording() {
    if (!recording_ || recording_->flush()) return;
    spdlog::error("the recording is not complete: is the disk full?");
    recording_ = nullptr;
}

std::string Service::summary() const {
    return fmt::format("{} of {} inputs open, {} targets have a position, {:g} Hz", inputs_.open() + cameras_.open(),
                       inputs_.size() + cameras_.size(), fusion_.positions(), settings_.engine.fusion.rate_hz);
}

} // namespace locus
