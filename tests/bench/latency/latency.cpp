// How long a measurement takes from its last byte on the wire to the client's line, beside a bare copy program, and how
// punctual the ticks are beside a bare clock_nanosleep loop, in one run on one machine. Writes the Markdown of
// docs/latency.md to standard output:  build/release/tests/bench/latency > docs/latency.md   (about two minutes)
#include "daemon/realtime.h"
#include "daemon/tick_schedule.h"
#include "drivers/uwb/trek1000.h"
#include "tests/bench/latency/bare_copy.h"
#include "tests/bench/latency/measure.h"
#include "tests/bench/latency/recorder.h"
#include "tests/support/socket_client.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

namespace locus::bench {
namespace {

constexpr int reports = 400;
constexpr int priority = 50;

constexpr Vec3 anchors[8]{{0, 0, 0}, {20, 0, 3}, {20, 15, 0}, {0, 15, 3},
                          {0, 0, 3}, {20, 0, 0}, {20, 15, 3}, {0, 15, 0}};

std::string config(const test::TemporaryFolder& folder, double rate_hz) {
    std::string text = "site:\n  name: bench\n  anchors:\n";
    for (int i = 0; i < 8; ++i)
        text += fmt::format("    - {{name: A{0}, address: {0}, position_site_m: [{1}, {2}, {3}]}}\n", i, anchors[i][0],
                            anchors[i][1], anchors[i][2]);
    text += fmt::format("inputs: [{{name: tag, transport: pty, path: {}, decoder: trek1000, tag_offset: 16}}]\n",
                        folder / "tty");
    text += fmt::format("fusion: {{rate_hz: {}}}\npublish: {{socket: {}}}\nrealtime: {{priority: {}}}\n", rate_hz,
                        folder / "sock", priority);
    return text;
}

/// One line of ranges of a tag that stands still.
std::string report(std::uint16_t tag, std::uint8_t sequence) {
    uwb::TrekReport report;
    report.mask = 0xff;
    report.columns = 8;
    for (std::size_t i = 0; i < 8; ++i)
        report.range_mm[i] = static_cast<std::int32_t>(
            1000 * std::hypot(7 + 0.1 * tag - anchors[i][0], 5 - anchors[i][1], 1.2 - anchors[i][2]));
    report.sequence = sequence;
    report.tag = tag;
    return encode(report);
}

/// A report each 40 to 60 ms, seed 1; when the last byte of each was given to the terminal.
std::vector<Timestamp> send_reports(const test::FakeDevice& device, int count) {
    std::mt19937 random{1};
    std::uniform_int_distribution<std::int64_t> pause_ns{40'000'000, 60'000'000};
    std::vector<Timestamp> sent;
    std::thread{[&] {
        schedule_this_thread(priority);
        for (int i = 0; i < count; ++i) {
            sleep_until(monotonic_now() + Duration{pause_ns(random)});
            const std::string line = report(0, static_cast<std::uint8_t>(i));
            sent.push_back(monotonic_now());
            device.send(line);
        }
    }}.join();
    return sent;
}

Figures bare_copy() {
    const test::TemporaryFolder folder;
    const test::FakeDevice device{folder / "tty"};
    const BareCopy copy{folder / "tty", folder / "sock", priority};
    const test::SocketClient client{folder / "sock"};
    Recorder recorder{client.fd(), priority};
    const auto sent = send_reports(device, reports);
    std::this_thread::sleep_for(std::chrono::milliseconds{200});
    const auto lines = recorder.lines();
    std::vector<double> late_us;
    for (std::size_t i = 0; i < std::min(sent.size(), lines.size()); ++i)
        late_us.push_back(to_us(lines[i].received - sent[i]));
    return Figures::of(late_us);
}

struct Daemon {
    explicit Daemon(double rate_hz) {
        test::write_all(folder / "yaml", config(folder, rate_hz));
        process = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", folder / "yaml"},
                                                        folder / "log");
        client = std::make_unique<test::SocketClient>(folder / "sock");
        test::eventually(
            [&] { return client->ask("?SOURCES;", "SOURCES").dump().find("\"open\"") != std::string::npos; });
    }

    test::TemporaryFolder folder;
    test::FakeDevice device{folder / "tty"};
    std::unique_ptr<test::DaemonProcess> process;
    std::unique_ptr<test::SocketClient> client;
};

struct PoseSeen {
    Timestamp received{};
    Timestamp tick{};
    double variance_m2 = 0;
};

std::vector<PoseSeen> poses_of(const std::vector<TimedLine>& lines) {
    std::vector<PoseSeen> poses;
    for (const TimedLine& line : lines) {
        const auto object = nlohmann::json::parse(line.text, nullptr, false);
        if (object.is_object() && object.value("class", "") == "POSE")
            poses.push_back({line.received, timestamp_from_s(object["time"].get<double>()),
                             object["covariance_m2"][0].get<double>()});
    }
    return poses;
}

struct DaemonLatency {
    Figures wire_to_line; ///< from the last byte to the first pose that it has changed
    Figures tick_to_line; ///< the same less the wait for the tick
};

/// A pose holds a new measurement when its variance has fallen: prediction only lets it grow.
DaemonLatency through_daemon(double rate_hz) {
    Daemon daemon{rate_hz};
    send_reports(daemon.device, 40); // the filter starts and settles
    daemon.client->ask("?WATCH={};", "WATCH");
    Recorder recorder{daemon.client->fd(), priority};
    const auto sent = send_reports(daemon.device, reports);
    std::this_thread::sleep_for(std::chrono::milliseconds{200});
    const auto poses = poses_of(recorder.lines());
    std::vector<double> wire_us, tick_us;
    std::size_t next = 1;
    for (const Timestamp time : sent) {
        while (next < poses.size() &&
               (poses[next].tick < time || poses[next].variance_m2 >= poses[next - 1].variance_m2))
            ++next;
        if (next >= poses.size()) break;
        wire_us.push_back(to_us(poses[next].received - time));
        tick_us.push_back(to_us(poses[next].received - poses[next].tick));
    }
    return {Figures::of(wire_us), Figures::of(tick_us)};
}

std::vector<double> bare_ticks(double rate_hz, std::chrono::seconds span) {
    std::vector<double> late_us;
    std::thread{[&] {
        schedule_this_thread(priority);
        TickSchedule schedule{period_of(rate_hz)};
        const Timestamp end = monotonic_now() + span;
        for (Timestamp tick = schedule.next(monotonic_now()); tick < end; tick = schedule.next(monotonic_now())) {
            sleep_until(tick);
            late_us.push_back(to_us(monotonic_now() - tick));
        }
    }}.join();
    return late_us;
}

void print_jitter(double rate_hz) {
    Daemon daemon{rate_hz};
    const Figures bare = Figures::of(bare_ticks(rate_hz, std::chrono::seconds{11}));
    const auto late = daemon.client->ask("?STATUS;", "STATUS")["tick_late_us"];
    fmt::print("| bare clock_nanosleep loop, {:g} Hz | {:.0f} | {:.0f} | {:.0f} |\n", rate_hz, bare.p50, bare.p99,
               bare.max);
    fmt::print("| fusion thread, {:g} Hz | {:.0f} | {:.0f} | {:.0f} |\n", rate_hz, late["p50"].get<double>(),
               late["p99"].get<double>(), late["max"].get<double>());
}

/// Ten tags at 10 Hz, evenly spread.
void send_ten_tags(const test::FakeDevice& device, int rounds) {
    const Timestamp begin = monotonic_now();
    for (int i = 0; i < 10 * rounds; ++i) {
        sleep_until(begin + i * std::chrono::milliseconds{10});
        device.send(report(static_cast<std::uint16_t>(i % 10), static_cast<std::uint8_t>(i / 10)));
    }
}

void print_cpu() {
    Daemon daemon{100};
    daemon.client->ask("?WATCH={};", "WATCH");
    Recorder reader{daemon.client->fd(), priority};
    send_ten_tags(daemon.device, 20);
    const Timestamp begin = monotonic_now();
    auto before = cpu_ns(daemon.process->pid());
    send_ten_tags(daemon.device, 100);
    const double span_ns = static_cast<double>((monotonic_now() - begin).count());
    double all = 0;
    fmt::print("| thread | % of one core |\n|---|---|\n");
    for (const auto& [name, ns] : cpu_ns(daemon.process->pid())) {
        const double percent = 100 * (ns - before[name]) / span_ns;
        all += percent;
        fmt::print("| {} | {:.2f} |\n", name, percent);
    }
    fmt::print("| all | {:.2f} |\n", all);
}

void print_row(std::string_view what, const Figures& figures) {
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {} |\n", what, figures.p50, figures.p99, figures.max, figures.count);
}

void print_latency_rows(std::string_view where) {
    print_row(fmt::format("bare copy, terminal to socket{}", where), bare_copy());
    for (const double rate_hz : {100.0, 1000.0}) {
        const auto [wire, tick] = through_daemon(rate_hz);
        print_row(fmt::format("locusd at {:g} Hz{}", rate_hz, where), wire);
        print_row(fmt::format("of it after the tick, {:g} Hz{}", rate_hz, where), tick);
    }
}

/// Programs that want every processor, at ordinary priority.
class BusyNeighbours {
  public:
    BusyNeighbours() {
        for (unsigned i = 0; i < 4 * std::thread::hardware_concurrency(); ++i)
            threads_.emplace_back([](const std::stop_token& stop) {
                while (!stop.stop_requested()) {
                }
            });
    }

  private:
    std::vector<std::jthread> threads_;
};

void print_latency() {
    fmt::print(
        "| from the last byte written into a pseudo-terminal to the line at a socket client, us | p50 | p99 | max "
        "| reports |\n|---|---|---|---|---|\n");
    print_latency_rows("");
    const BusyNeighbours busy;
    print_latency_rows(", busy machine");
}

void print_heading() {
    std::string load;
    std::getline(std::ifstream{"/proc/loadavg"}, load, ' ');
    fmt::print(
        "# Latency\n\nMade by `build/release/tests/bench/latency > docs/latency.md`, all in one run. A pose goes out "
        "at "
        "the next tick, so the wait for it is most\nof the way: anything from nothing to one period, 5 ms in the mean "
        "at "
        "100 Hz and so the 5 ms of its p50; `fusion.rate_hz` shortens it. The\nrest is the row `after the tick`: "
        "engine, "
        "ring, wake-up, JSON and socket. `busy machine`: four busy loops a core run beside it at\nordinary priority. "
        "Every thread that a measurement passes is SCHED_FIFO where that is allowed (`realtime.priority`), and so are\n"
        "the bare copy, the sender and the client. Maxima are the machine's: a stall of the virtual machine hits every "
        "row alike.\n\nThis run: {} cores, load {} before it began.\n\n",
        std::thread::hardware_concurrency(), load);
}

} // namespace
} // namespace locus::bench

int main() {
    locus::bench::print_heading();
    locus::bench::print_latency();
    fmt::print("\n## Ticks\nLateness of the wake-up in us, SCHED_FIFO where allowed, both at the same time over ten "
               "seconds.\n\n"
               "| | p50 | p99 | max |\n|---|---|---|---|\n");
    for (const double rate_hz : {100.0, 1000.0}) locus::bench::print_jitter(rate_hz);
    fmt::print("\n## Processor\n10 tags x 8 anchors x 10 Hz in, 100 Hz out (1,000 poses a second) to one client.\n\n");
    locus::bench::print_cpu();
}
