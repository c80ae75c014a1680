// locus watch: the poses as they come, as a table that stays in place, as lines, or as the daemon's own JSON lines.
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
    void refresh() override { screen_.show(poses_.lines(to_s(monotonic_now()))); }

  private:
    PosePanel poses_;
    LivePanel screen_;
};

std::unique_ptr<View> make_view(const Client& client, const WatchOptions& options, bool as_json) {
    if (on_terminal() && !as_json) return std::make_unique<LiveTable>(client.version(), options);
    return std::make_unique<Lines>(as_json);
}

std::uint64_t stream(Client& client, const WatchOptions& options, View& view) {
    const Deadline end = deadline_in(options.seconds);
    Every refresh(200ms, steady_clock::now() + 50ms), targets(1s, steady_clock::now());
    std::uint64_t poses = 0;
    while (poses < options.count && steady_clock::now() < end) {
        if (targets.due()) client.send("?TARGETS;\n");
        if (const auto message = client.receive(std::min({end, refresh.next(), targets.next()}))) {
            view.take(*message);
            poses += message->class_name == "POSE";
        }
        if (refresh.due()) view.refresh();
    }
    view.refresh();
    return poses;
}

int watch(Client& client, WatchOptions options, bool as_json) {
    const auto view = make_view(client, options, as_json);
    if (!options.request.rate_hz) options.request.rate_hz = view->rate_hz();
    start_watching(client, options.request);
    return stream(client, options, *view) > 0 ? exit_yes : exit_no;
}

} // namespace

void add_watch(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<WatchOptions>();
    CLI::App& app = add_client_command(
        root, exit_code,
        {"watch", "Shows the poses as they come", "Print the daemon's POSE lines as they are, all of them",
         "On a terminal the table stays in place; into a pipe goes a line a pose.\n"
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
