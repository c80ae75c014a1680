// locus watch: the poses as they come, as a table that stays in place, as lines, or as the daemon's own JSON lines.
#include "drivers/back_off.h"
#include "drivers/clock.h"
#include "tools/client/command.h"
#include "tools/client/fields.h"
#include "tools/client/watching.h"
#include "tools/show/pose_panel.h"
#include "tools/show/terminal.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <thread>

namespace locus {

namespace {

using namespace locus::tools;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

struct WatchOptions {
    WatchRequest request;
    std::uint64_t count = std::numeric_limits<std::uint64_t>::max();
    double seconds = std::numeric_limits<double>::infinity();
};

// Something that is due again and again, however late it was seen to.
class Every {
  public:
    Every(steady_clock::duration period, Deadline first) : period_(period), next_(first) {}
    Deadline next() const { return next_; }
    bool due() {
        const Deadline now = steady_clock::now();
        if (now < next_) return false;
        next_ = now + period_;
        return true;
    }

  private:
    steady_clock::duration period_;
    Deadline next_;
};

class View {
  public:
    virtual ~View() = default;
    virtual void take(const Message& message) = 0;
    virtual void refresh() = 0;
    /// That the connection is lost, or there again.
    virtual void tell(const std::string& sentence) = 0;
    /// Poses of each target a second that it has use for; empty: all.
    virtual std::optional<double> rate_hz() const = 0;
};

// A line a pose, out at once: the reader may be a program. Silence would leave a person to guess.
class Lines : public View {
  public:
    explicit Lines(bool as_json) : as_json_(as_json) {}
    void take(const Message& message) override {
        if (message.class_name != "POSE") return;
        fmt::print("{}\n", as_json_ ? message.line : pose_line(message.fields));
        std::fflush(stdout);
        silent_ = false;
    }
    std::optional<double> rate_hz() const override { return as_json_ ? std::nullopt : std::optional{5.0}; }
    void refresh() override {
        if (silent_ && hint_.due()) complain("no pose yet: `locus status` says what is missing");
    }
    void tell(const std::string& sentence) override { complain(sentence); }

  private:
    bool as_json_;
    bool silent_ = true;
    Every hint_{10s, deadline_in(2)};
};

class LiveTable : public View {
  public:
    LiveTable(const Message& version, const WatchOptions& options) : poses_(version, options.request.targets) {}
    void take(const Message& message) override { poses_.take(message); }
    std::optional<double> rate_hz() const override { return 20; } // so that what is shown is hardly old
    void refresh() override {
        auto lines = poses_.lines(to_s(monotonic_now()));
        if (!told_.empty()) lines.push_back(told_);
        screen_.show(std::move(lines));
    }
    void tell(const std::string& sentence) override {
        told_ = sentence;
        refresh();
    }

  private:
    std::string told_;
    PosePanel poses_;
    LivePanel screen_;
};

std::unique_ptr<View> make_view(const Client& client, const WatchOptions& options, bool as_json) {
    if (on_terminal() && !as_json) return std::make_unique<LiveTable>(client.version(), options);
    return std::make_unique<Lines>(as_json);
}

class Watching {
  public:
    Watching(Client& client, const WatchOptions& options, View& view)
        : client_(client), options_(options), view_(view), end_(deadline_in(options.seconds)) {}

    /// The poses that came. Throws DaemonError when the daemon was not back by the end.
    std::uint64_t run() {
        while (!done()) {
            try {
                start_watching(client_, options_.request);
                stream();
            } catch (const ConnectionLost& lost) {
                view_.tell(fmt::format("{}; waiting for it to come back", lost.what()));
                come_back();
                view_.tell("connected again");
            }
        }
        return poses_;
    }

  private:
    bool done() const { return poses_ >= options_.count || steady_clock::now() >= end_; }

    void stream() {
        Every refresh(200ms, steady_clock::now() + 50ms), targets(1s, steady_clock::now());
        while (!done()) {
            if (targets.due()) client_.send("?TARGETS;\n");
            if (const auto message = client_.receive(std::min({end_, refresh.next(), targets.next()}))) {
                back_off_.reset(); // not at the connection: one that takes it and says nothing must not be hurried
                view_.take(*message);
                poses_ += message->class_name == "POSE";
            }
            if (refresh.due()) view_.refresh();
        }
        view_.refresh();
    }

    void come_back() {
        for (;;) {
            std::this_thread::sleep_until(std::min(end_, steady_clock::now() + back_off_.next()));
            try {
                return client_.connect_again();
            } catch (const DaemonError&) {
                if (done()) throw;
            }
        }
    }

    Client& client_;
    const WatchOptions& options_;
    View& view_;
    Deadline end_;
    BackOff back_off_;
    std::uint64_t poses_ = 0;
};

int watch(Client& client, WatchOptions options, bool as_json) {
    const auto view = make_view(client, options, as_json);
    if (!options.request.rate_hz) options.request.rate_hz = view->rate_hz();
    return Watching(client, options, *view).run() > 0 ? exit_yes : exit_no;
}

} // namespace

void add_watch(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<WatchOptions>();
    CLI::App& app = add_client_command(
        root, exit_code,
        {"watch", "Shows the poses as they come", "Print the daemon's POSE lines as they are, all of them",
         "On a terminal the table stays in place; into a pipe goes a line a pose. When the daemon restarts it\n"
         "says so (on standard error) and goes on, until Ctrl-C.\n"
         "Examples:\n  locus watch\n  locus watch --target forklift-1 --seconds 60 --json > forklift.jsonl\n"
         "Exit codes: 0 a pose came, 1 none came, 3 the daemon cannot be reached."},
        [options](Client& client, bool as_json) { return watch(client, *options, as_json); });
    app.add_option("--target", options->request.targets, "Only this target; can be given again")
        ->allow_extra_args(false)
        ->type_name("NAME");
    app.add_option("--rate", options->request.rate_hz,
                   "At most so many poses of each target a second (5 as lines, all with --json)")
        ->type_name("HZ")
        ->check(CLI::PositiveNumber);
    app.add_option("--count", options->count, "Stop after so many poses")->type_name("N")->check(CLI::PositiveNumber);
    app.add_option("--seconds", options->seconds, "Stop after so long")->type_name("S")->check(CLI::PositiveNumber);
}

} // namespace locus
