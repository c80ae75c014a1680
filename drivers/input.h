// Input: one transport with its decoder, read by one thread of its own, measurements into one ring. It opens its
// device, opens it again after every loss, for ever, and counts all that happens. It never blocks on anybody but its
// device.
//
//   Input input{{.name = "hall", .index = 0, .transport = row.make(...), .decoder = ..., .ring = &ring}};
//   std::jthread thread{[&](std::stop_token stop) { input.run(stop); }};
//   ... input.status().state.load(), .measurements.load(), .trouble.get() from any thread ...
#pragma once

#include "drivers/back_off.h"
#include "drivers/input_status.h"
#include "drivers/transport/transport.h"
#include "fusion/ring.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

namespace locus {

using MeasurementRing = Ring<Measurement, 4096>;

/// Something that the log should say, once per change and not once per try.
struct InputEvent {
    enum class Kind : std::uint8_t {
        opened,      ///< first time, or again
        unavailable, ///< cannot be opened, for a reason not told yet
        lost,        ///< was open, is gone
        trouble,     ///< works, but something changed for the worse ("error passive"); text empty: well again
        ended,       ///< a recording is at its end
    };
    Kind kind;
    std::string_view text; ///< a sentence; valid during the call
};

struct InputParts {
    std::string name{};
    std::uint16_t index = 0; ///< place in the settings; goes into every Measurement
    std::unique_ptr<Transport> transport{};
    std::unique_ptr<Decoder> decoder{}; ///< may be null: then only the tap listens
    Duration delay{0};                  ///< from the sample to the wire, taken off every measurement's time
    MeasurementRing* ring = nullptr;    ///< may be null: then measurements are only counted, and devices still asked
    PacketSink* tap = nullptr;          ///< sees every packet as the transport gave it, before the decoder
    std::function<void(const InputEvent&)> on_event{}; ///< called in the input's thread
};

class Input : private PacketSink, private MeasurementSink {
  public:
    explicit Input(InputParts parts) : parts_{std::move(parts)} {}

    /// Reads until asked to stop (heard within about 0.1 s) or a recording ends. Call it once, in its own thread.
    void run(const std::stop_token& stop);

    const std::string& name() const { return parts_.name; }
    std::uint16_t index() const { return parts_.index; }
    const InputStatus& status() const { return status_; }

  private:
    bool open();
    ReadStatus read_until_lost(const std::stop_token& stop);
    void fail(InputEvent::Kind kind, std::string_view text);
    void note_trouble(std::string_view text);
    void ask_device() const;
    void copy_counters();
    void tell_trouble();
    void emit(InputEvent::Kind kind, std::string_view text) const;

    void packet(const Packet& packet) override;
    void accept(Timestamp time, const Observation& observation) override;
    void frame(std::span<const std::uint8_t> bytes) override;
    void refuse(Refusal reason) override;

    InputParts parts_;
    InputStatus status_;
    BackOff back_off_;
    std::string told_; ///< the trouble that was told last
    bool was_open_ = false;
    bool in_step_ = false; ///< the decoder knows where frames begin
    std::uint32_t sequence_ = 0;
};

} // namespace locus
