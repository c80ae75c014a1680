// One recording of everything at once: several devices of a kind and other transports, on one clock; played again it
// gives what the decoders gave live. Devices that must be asked are asked while it records.
#include "config/load.h"
#include "drivers/clock.h"
#include "drivers/uwb/trek1000.h"
#include "tests/support/fake_device.h"
#include "tests/support/tcp_server.h"
#include "tests/unit/tools/fake_daemon.h"
#include "tools/replay/recording.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sys/socket.h>

#include <fstream>
#include <map>
#include <thread>

namespace locus {
namespace {

using nlohmann::json;

class RecordAll : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream{folder_ / name} << text;
        return folder_ / name;
    }
    /// Counts per input, by name.
    static std::map<std::string, json> by_name(const std::string& counts) {
        std::map<std::string, json> inputs;
        const json all = json::parse(counts);
        for (const json& input : all["inputs"]) inputs[input["name"]] = input;
        return inputs;
    }
    test::TemporaryFolder folder_;
};

/// The n-th line that is sent, to whichever device: its ranges say so.
std::string line_of(int n) {
    uwb::TrekReport report;
    report.mask = 1;
    report.range_mm = {1000 + n};
    return uwb::encode(report);
}

class UdpSender {
  public:
    explicit UdpSender(int port) : fd_{::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {
        address_.sin_family = AF_INET;
        address_.sin_port = htons(static_cast<std::uint16_t>(port));
        address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    }
    void send(const std::string& bytes) const {
        ::sendto(fd_.get(), bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address_),
                 sizeof address_);
    }

  private:
    UniqueFd fd_;
    sockaddr_in address_{};
};

/// A port that nobody has, for a moment at least.
int free_udp_port() {
    const UniqueFd fd{::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)};
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), size);
    ::getsockname(fd.get(), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
}

TEST_F(RecordAll, InputsOfManyKindsComeBackAsTheyCame) {
    const test::FakeDevice north{folder_ / "north"}, south{folder_ / "south"};
    const test::TcpServer tcp;
    const int udp_port = free_udp_port();
    const UdpSender udp{udp_port};
    const std::string yaml =
        write("hall.yaml", "inputs:\n  - {name: north, transport: pty, path: " + (folder_ / "north") +
                               ", decoder: trek1000}\n  - {name: south, transport: pty, path: " + (folder_ / "south") +
                               ", decoder: trek1000}\n  - {name: far, transport: tcp, host: 127.0.0.1, port: " +
                               std::to_string(tcp.port()) +
                               ", decoder: trek1000}\n  - {name: near, transport: udp, address: 127.0.0.1, port: " +
                               std::to_string(udp_port) + ", decoder: trek1000}\n");
    std::jthread talk{[&](const std::stop_token& stop) {
        for (int n = 0; !stop.stop_requested(); ++n) {
            const std::string line = line_of(n);
            n % 4 == 0   ? void(north.send(line))
            : n % 4 == 1 ? void(south.send(line))
            : n % 4 == 2 ? tcp.send(line)
                         : udp.send(line);
            std::this_thread::sleep_for(std::chrono::milliseconds{4});
        }
    }};
    const Timestamp begun = monotonic_now();
    const auto recorded =
        run_locus({add_record}, {"record", "--config", yaml, "-o", folder_ / "all.log", "--seconds", "1.5", "--json"});
    const Timestamp ended = monotonic_now();
    talk.request_stop();
    ASSERT_EQ(recorded.exit_code, exit_yes) << recorded.err;

    struct Heard {
        std::uint16_t input;
        double range_m;
        Timestamp time;
    };
    std::vector<Heard> heard;
    const Settings settings = *load_settings(yaml).settings;
    const auto report = replay::read_recording(folder_ / "all.log", settings, [&](const Measurement& m, Timestamp) {
        heard.push_back({m.input, std::get<Range>(m.observation).range_m, m.time});
    });
    EXPECT_EQ(report.bad_lines, 0u);
    std::map<std::string, std::uint64_t> replayed;
    for (const Heard& one : heard) ++replayed[settings.inputs[one.input].name];
    for (const auto& [name, counts] : by_name(recorded.out)) {
        EXPECT_EQ(replayed[name], counts["measurements"].get<std::uint64_t>()) << name;
        EXPECT_GT(replayed[name], 5u) << name;
    }
    // By one clock all of it came while it was recorded, and what each device said came in the order that it was said.
    std::map<std::uint16_t, Heard> last;
    for (const Heard& one : heard) {
        EXPECT_TRUE(one.time >= receive_stamp(begun) && one.time <= ended);
        if (const auto before = last.find(one.input); before != last.end()) {
            EXPECT_LT(before->second.range_m, one.range_m);
            EXPECT_LE(before->second.time, one.time);
        }
        last[one.input] = one;
    }
}

TEST_F(RecordAll, DevicesThatMustBeAskedAreAsked) {
    const test::FakeDevice device{folder_ / "tty"};
    const std::string yaml = write("hall.yaml", "inputs:\n  - {name: it, transport: pty, path: " + (folder_ / "tty") +
                                                    ", decoder: dwm1001_tlv, tag: 1}\n");
    run_locus({add_record}, {"record", "--config", yaml, "-o", folder_ / "it.log", "--seconds", "0.4"});
    EXPECT_EQ(device.received().substr(0, 2), std::string("\x0c\0", 2));
}

} // namespace
} // namespace locus
