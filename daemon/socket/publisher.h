// The publisher: one thread, one epoll, all clients. It empties the fusion thread's rings and gives each client the
// lines it asked for; a slow client loses its own oldest poses and delays nobody.
#pragma once

#include "daemon/output.h"
#include "daemon/rate_limit.h"
#include "daemon/socket/client.h"
#include "daemon/socket/input_rates.h"
#include "daemon/socket/listener.h"
#include "daemon/socket/picture.h"
#include "daemon/socket/post.h"
#include "daemon/socket/reason_watch.h"
#include "daemon/socket/views.h"

#include <atomic>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

namespace locus {

class Publisher {
  public:
    /// `ticked` is raised by the fusion thread when `output` holds something new. All but the listener outlive this.
    /// Throws std::runtime_error with a sentence when the NMEA output cannot be made.
    Publisher(Listener listener, FusionOutput& output, const Wake& ticked, Post& post,
              std::unique_ptr<const Roster> roster);

    /// Serves until asked to stop (heard at once). Call it once, in its own thread.
    void run(const std::stop_token& stop);

    /// Moves at least ten times a second while run() is well. Any thread.
    std::uint64_t heartbeat() const { return heartbeat_.load(std::memory_order_relaxed); }

  private:
    using Id = std::uint64_t;
    using Clients = std::map<Id, Client>;

    void add_to_epoll(int fd, Id id) const;
    void serve(Id id, std::uint32_t events);
    void accept_all();
    void pause_accepting();
    void resume_accepting();
    void arm(int fd, Id id, std::uint32_t events) const;
    void welcome(UniqueFd fd);
    void serve_client(Clients::iterator client, std::uint32_t events);
    void answer(Id id, Client& client, const ParsedCommand& parsed);
    std::string answer_to(Id id, Client& client, const Command& command);
    std::string request_reload(Id id, const Client& client);
    std::string request_view(Id id, const Client& client, const std::string& camera);
    void serve_views();
    void flush(Clients::iterator client);
    void flush_all();

    void open_post();
    void follow_roster();
    void take_output();
    void take_pose(const PoseItem& item);
    void take_smoothed(const Pose& pose);
    void take_reading(const ReadingItem& item);
    void take_source(const SourceItem& item);

    Listener listener_;
    FusionOutput& output_;
    const Wake& ticked_;
    Post& post_;
    std::unique_ptr<const Roster> roster_;
    UniqueFd epoll_;
    Clients clients_;
    Id next_id_; // NOLINT(*-default-member-init): the first number is known to the .cpp alone
    std::optional<Timestamp> accept_again_; ///< set: no new clients until then
    std::optional<NmeaOutput> nmea_;
    Picture picture_;
    ReasonWatch reasons_;
    InputRates input_rates_;
    Views views_;
    RateLimit reason_lines_{20, std::chrono::seconds{1}};
    std::atomic<std::uint64_t> heartbeat_{0};
};

} // namespace locus
