// SocketCAN, classic and FD. Frames are fetched in batches and stamped by the kernel, by the adapter where it has a
// clock. An interface that goes down, off the bus or away is a loss like a pulled cable; it is bound anew when it is
// back.
#include "drivers/clock.h"
#include "drivers/transport/can_batch.h"
#include "drivers/transport/can_filter.h"
#include "drivers/transport/can_health.h"
#include "drivers/transport/can_socket.h"
#include "drivers/transport/receive_stamps.h"
#include "drivers/transport/rows.h"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace locus {
namespace {

struct CanSettings {
    std::string interface;
    std::string filter;
    bool adapter_stamps = true;
};

std::string check_settings(const void* settings) {
    std::string error;
    parse_can_filters(static_cast<const CanSettings*>(settings)->filter, error);
    return error;
}

constexpr std::array options{
    required_option<&CanSettings::interface>("interface", "Network interface, e.g. can0 or vcan0."),
    option<&CanSettings::filter>("filter", "Ids that are wanted, e.g. 123,200:7F0,18FF1234 (id:mask, hex; 3 digits "
                                           "standard, 8 extended); empty: all."),
    option<&CanSettings::adapter_stamps>("adapter_stamps", "Whether the adapter's own receive stamps are used where it "
                                                           "has them."),
};

constexpr int receive_buffer_bytes = 1 << 20;

template <class Value>
void set(int fd, int level, int option, const Value& value) {
    ::setsockopt(fd, level, option, &value, sizeof value);
}

void ask_for_stamps_and_errors(int fd) {
    set(fd, SOL_SOCKET, SO_TIMESTAMPING,
        SOF_TIMESTAMPING_SOFTWARE | SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_RAW_HARDWARE);
    set(fd, SOL_SOCKET, SO_RXQ_OVFL, 1);
    set(fd, SOL_SOCKET, SO_RCVBUF, receive_buffer_bytes);
    set(fd, SOL_SOCKET, SO_RCVBUFFORCE, receive_buffer_bytes); // past the system's limit, where allowed
    set(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, can_err_mask_t{CAN_ERR_MASK});
}

class Can : public Transport {
  public:
    explicit Can(const CanSettings& settings) : settings_{settings}, health_{settings.interface} {}

    bool open() override {
        error_.clear();
        const auto filters = parse_can_filters(settings_.filter, error_);
        if (!error_.empty() || !socket_.open(settings_.interface, error_)) return false;
        ask_for_stamps_and_errors(socket_.fd());
        if (!filters.empty()) {
            ::setsockopt(socket_.fd(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                         static_cast<socklen_t>(filters.size() * sizeof filters[0]));
        }
        health_.reset();
        adapter_clock_ = {};
        drops_.reset();
        return true;
    }

    void close() override { socket_.close(); }

    ReadStatus read(PacketSink& sink, Duration timeout) override {
        pollfd waiting{socket_.fd(), POLLIN, 0};
        const auto timeout_ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
        if (::poll(&waiting, 1, static_cast<int>(timeout_ms)) <= 0) return ReadStatus::ok;
        const int frames = batch_.receive(socket_.fd());
        if (frames < 0) return errno == EAGAIN || errno == EINTR ? ReadStatus::ok : lost(errno);
        hand_over(static_cast<std::size_t>(frames), sink);
        if (!health_.bus_off()) return ReadStatus::ok;
        error_ = health_.trouble();
        return ReadStatus::lost;
    }

    bool write(const Packet& packet) override { return socket_.send(packet); }

    std::uint64_t kernel_dropped() const override { return drops_.total(); }
    std::uint64_t wire_errors() const override { return health_.error_frames(); }
    std::string_view trouble() const override { return health_.trouble(); }
    std::string_view last_error() const override { return error_; }

  private:
    void hand_over(std::size_t frames, PacketSink& sink) {
        const Duration offset = realtime_offset();
        const Timestamp now = monotonic_now();
        for (std::size_t i = 0; i < frames; ++i) {
            auto packet = batch_.packet(i);
            if (!packet) continue;
            packet->time = stamp(batch_.control(i), offset, now);
            const bool error_frame = packet->can_id & CAN_ERR_FLAG;
            error_frame ? health_.take(*packet) : sink.packet(*packet);
        }
    }

    Timestamp stamp(const ControlData& control, Duration offset, Timestamp now) {
        drops_.take(control);
        Timestamp time = kernel_time(control, offset, now);
        if (control.adapter && settings_.adapter_stamps) time = adapter_clock_.to_monotonic(*control.adapter, time);
        return receive_stamp(time);
    }

    ReadStatus lost(int reason) {
        const std::string& name = settings_.interface;
        error_ = reason == ENETDOWN ? name + " went down"
                 : reason == ENODEV ? name + " was removed"
                                    : name + " cannot be read: " + std::strerror(reason);
        return ReadStatus::lost;
    }

    const CanSettings settings_;
    CanSocket socket_;
    CanHealth health_;
    AdapterClock adapter_clock_;
    CanBatch batch_;
    KernelDrops drops_;
    std::string error_;
};

} // namespace

TransportRow can_row() {
    return {"can",
            "SocketCAN interface, classic and FD frames.",
            Wire::can,
            false,
            option_table<CanSettings>(options, {}, check_settings),
            [](const void* settings) -> std::unique_ptr<Transport> {
                return std::make_unique<Can>(*static_cast<const CanSettings*>(settings));
            }};
}

} // namespace locus
