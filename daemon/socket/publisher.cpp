#include "daemon/socket/publisher.h"

#include "daemon/socket/answers.h"
#include "daemon/socket/pose_line.h"
#include "daemon/socket/reading_line.h"
#include "drivers/clock.h"

#include <spdlog/spdlog.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace locus {
namespace {

// Numbers in epoll below the clients'.
enum : std::uint64_t { listener_id, tick_id, post_id, first_client_id };

constexpr int heartbeat_ms = 100;

/// Poses that wait in the kernel can no longer be dropped for newer ones, so little of it.
constexpr int kernel_buffer_bytes = 32768;

} // namespace

Publisher::Publisher(Listener listener, FusionOutput& output, const Wake& ticked, Post& post,
                     std::unique_ptr<const Roster> roster)
    : listener_{std::move(listener)}, output_{output}, ticked_{ticked}, post_{post}, roster_{std::move(roster)},
      epoll_{::epoll_create1(EPOLL_CLOEXEC)}, next_id_{first_client_id} {
    if (const std::optional<NmeaPlan>& plan = roster_->nmea) nmea_.emplace(*plan);
    add_to_epoll(listener_.fd(), listener_id);
    add_to_epoll(ticked_.fd(), tick_id);
    add_to_epoll(post_.publisher.fd(), post_id);
}

void Publisher::add_to_epoll(int fd, Id id) const {
    epoll_event event{.events = EPOLLIN, .data = {.u64 = id}};
    if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event) != 0)
        throw std::system_error(errno, std::generic_category(), "epoll_ctl");
}

void Publisher::run(const std::stop_token& stop) {
    const std::stop_callback wake_up{stop, [this] { post_.publisher.raise(); }};
    std::array<epoll_event, 64> events;
    while (!stop.stop_requested()) {
        const int ready = ::epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()), heartbeat_ms);
        heartbeat_.fetch_add(1, std::memory_order_relaxed);
        for (int i = 0; i < ready; ++i)
            serve(events[static_cast<std::size_t>(i)].data.u64, events[static_cast<std::size_t>(i)].events);
        take_output();
        serve_views();
        flush_all();
        if (nmea_) nmea_->run(monotonic_now());
        resume_accepting();
        input_rates_.watch(roster_->inputs, monotonic_now());
    }
}

void Publisher::serve(Id id, std::uint32_t events) {
    if (id == listener_id) return accept_all();
    if (id == tick_id) return ticked_.hush();
    if (id == post_id) return open_post();
    if (const auto client = clients_.find(id); client != clients_.end()) serve_client(client, events);
}

void Publisher::accept_all() {
    for (;;) {
        UniqueFd fd{::accept4(listener_.fd(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)};
        if (!fd) break;
        welcome(std::move(fd));
    }
    if (errno != EAGAIN && errno != ECONNABORTED && errno != EINTR) pause_accepting();
}

/// No descriptor or memory left: whoever calls waits in the kernel's queue, and epoll must not report it for ever.
void Publisher::pause_accepting() {
    spdlog::warn("cannot take another client: {}; trying again in a second", std::strerror(errno));
    arm(listener_.fd(), listener_id, 0);
    accept_again_ = monotonic_now() + std::chrono::seconds{1};
}

void Publisher::resume_accepting() {
    if (!accept_again_ || monotonic_now() < *accept_again_) return;
    accept_again_.reset();
    arm(listener_.fd(), listener_id, EPOLLIN);
}

void Publisher::arm(int fd, Id id, std::uint32_t events) const {
    epoll_event event{.events = events, .data = {.u64 = id}};
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, fd, &event);
}

void Publisher::welcome(UniqueFd fd) {
    ::setsockopt(fd.get(), SOL_SOCKET, SO_SNDBUF, &kernel_buffer_bytes, sizeof kernel_buffer_bytes);
    const int handle = fd.get();
    Client client{std::move(fd), static_cast<std::size_t>(roster_->publish.client_queue)};
    if (clients_.size() >= static_cast<std::size_t>(roster_->publish.max_clients)) {
        client.queue.push_answer(error_line("too many clients; publish.max_clients sets how many there may be"));
        client.flush();
        return;
    }
    client.queue.push_answer(version_line(*roster_));
    client.armed = EPOLLIN;
    add_to_epoll(handle, next_id_);
    clients_.emplace(next_id_++, std::move(client));
}

void Publisher::serve_client(Clients::iterator client, std::uint32_t events) {
    const bool gone = (events & (EPOLLHUP | EPOLLERR)) != 0 || !client->second.receive();
    if (gone) {
        clients_.erase(client);
        return;
    }
    while (const auto command = client->second.next_command()) answer(client->first, client->second, *command);
}

void Publisher::answer(Id id, Client& client, const ParsedCommand& parsed) {
    const auto* bad = std::get_if<BadCommand>(&parsed);
    const std::string lines = bad ? error_line(bad->message) : answer_to(id, client, std::get<Command>(parsed));
    if (!lines.empty()) client.queue.push_answer(lines);
}

std::string Publisher::answer_to(Id id, Client& client, const Command& command) {
    switch (command.verb) {
    case Verb::watch:
        if (command.watch) client.watch = *command.watch;
        return watch_line(client.watch);
    case Verb::poll:
        return poll_lines(picture_, *roster_);
    case Verb::sources:
        return sources_line(picture_, *roster_, input_rates_, monotonic_now());
    case Verb::targets:
        return targets_line(picture_, *roster_, monotonic_now());
    case Verb::status:
        return status_line(picture_, *roster_, clients_.size(), monotonic_now());
    case Verb::reload:
        return request_reload(id, client);
    case Verb::view:
        return request_view(id, client, command.camera);
    }
    return {};
}

/// The answer comes later, from the main thread: empty.
std::string Publisher::request_reload(Id id, const Client& client) {
    if (!client.may_change()) return error_line("?RELOAD is for root and the daemon's own user; try sudo");
    if (!post_.requests.push({id})) return error_line("too many reloads are under way; try again");
    post_.main.raise();
    return {};
}

/// The answer comes when the camera's next picture is there: empty. Pictures of people are not for everybody who may
/// read poses.
std::string Publisher::request_view(Id id, const Client& client, const std::string& camera) {
    if (!client.may_change()) return error_line("?VIEW is for root and the daemon's own user; try sudo");
    const std::string wrong = views_.ask(id, camera, picture_, *roster_, monotonic_now());
    return wrong.empty() ? wrong : error_line(wrong);
}

void Publisher::serve_views() {
    views_.serve(*roster_, monotonic_now(), [this](Id id, const std::string& line) {
        if (const auto client = clients_.find(id); client != clients_.end()) client->second.queue.push_answer(line);
    });
}

void Publisher::open_post() {
    post_.publisher.hush();
    while (auto roster = post_.rosters.take()) {
        roster_ = std::move(roster);
        follow_roster();
    }
    while (const auto answer = post_.answers.take())
        if (const auto client = clients_.find(answer->client); client != clients_.end())
            client->second.queue.push_answer(reload_line(answer->ok, answer->problems));
}

/// A terminal that readers have open stays as long as its name does.
void Publisher::follow_roster() try {
    const std::optional<NmeaPlan>& plan = roster_->nmea;
    if (!plan) return nmea_.reset();
    if (nmea_ && nmea_->follow(*plan)) return;
    nmea_.reset();
    nmea_.emplace(*plan);
} catch (const std::runtime_error& error) {
    spdlog::error("there is no NMEA output: {}", error.what());
}

void Publisher::take_output() {
    for (PoseItem item; output_.poses.pop(item);) take_pose(item);
    for (ReadingItem item; output_.readings.pop(item);) take_reading(item);
    for (SourceItem item; output_.sources.pop(item);) take_source(item);
    for (TickItem item; output_.ticks.pop(item);) picture_.take(item);
}

/// Comes after the target's newest pose, as often, so it is thinned alike.
void Publisher::take_smoothed(const Pose& pose) {
    const auto found = picture_.targets().find(pose.target);
    if (found == picture_.targets().end() || !is_publishable(pose)) return;
    const TargetView& view = found->second;
    const std::string name = roster_->names.target(pose.target);
    const Timestamp previous = pose.estimate.time - (view.pose.estimate.time - view.previous);
    OpenLine line;
    for (auto& [id, client] : clients_) {
        if (!client.watch.wants_smoothed(name)) continue;
        if (!is_due(previous, pose.estimate.time, client.watch.rate_hz)) continue;
        if (!line)
            line = std::make_shared<const std::string>(
                open_pose_line(pose, roster_->names, view.reset_count(), "SMOOTHED"));
        client.queue.push_pose(line);
    }
}

void Publisher::take_pose(const PoseItem& item) {
    if (item.smoothed) return take_smoothed(item.pose);
    if (nmea_) nmea_->take(item.pose);
    const TargetView& view = picture_.take(item);
    if (!is_publishable(view.pose)) return;
    const std::string name = roster_->names.target(view.pose.target);
    OpenLine line;
    for (auto& [id, client] : clients_) {
        if (!client.watch.wants(name)) continue;
        if (!is_due(view.previous, view.pose.estimate.time, client.watch.rate_hz)) continue;
        if (!line)
            line = std::make_shared<const std::string>(open_pose_line(view.pose, roster_->names, view.reset_count()));
        client.queue.push_pose(line);
    }
}

void Publisher::take_reading(const ReadingItem& item) {
    const std::string name = roster_->names.target(item.tag);
    OpenLine line;
    for (auto& [id, client] : clients_) {
        if (!client.watch.wants_readings(name)) continue;
        if (!line) line = std::make_shared<const std::string>(open_reading_line(item, roster_->names));
        client.queue.push_pose(line);
    }
}

void Publisher::take_source(const SourceItem& item) {
    picture_.take(item);
    const Timestamp now = monotonic_now();
    const auto reason = reasons_.see(item.status, now);
    if (!reason) return;
    const auto held_back = reason_lines_.pass(now);
    if (!held_back) return;
    const std::string more = *held_back ? fmt::format(" ({} more such lines held back)", *held_back) : "";
    spdlog::info("source {}: {}{}", roster_->names.source(item.status.kind, item.status.source),
                 exclusion_sentence(*reason), more);
}

void Publisher::flush_all() {
    for (auto next = clients_.begin(); next != clients_.end();) flush(next++);
}

void Publisher::flush(Clients::iterator client) {
    auto& [id, self] = *client;
    if (!self.flush()) {
        clients_.erase(client);
        return;
    }
    const std::uint32_t interest = self.interest();
    if (interest == self.armed) return;
    arm(self.fd(), id, interest);
    self.armed = interest;
}

} // namespace locus
