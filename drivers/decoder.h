// Decoder: packets in, measurements out. It opens nothing, reads no clock, and believes no length, count or index that
// stands inside a packet. State only for frames that arrive in pieces.
#pragma once

#include "drivers/packet.h"
#include "fusion/measurement.h"
#include "fusion/option.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace locus {

/// Why a decoder threw something away.
enum class Refusal : std::uint8_t { garbage, too_long, bad_checksum, malformed, out_of_range, unknown_type, count_ };

inline constexpr std::size_t refusal_count = static_cast<std::size_t>(Refusal::count_);
inline constexpr std::array<std::string_view, refusal_count> refusal_names{"garbage",   "too_long",     "bad_checksum",
                                                                           "malformed", "out_of_range", "unknown_type"};

/// Whether the bytes themselves were damaged; else they made a frame, which said something that cannot be used.
constexpr bool is_damage(Refusal reason) { return reason != Refusal::out_of_range && reason != Refusal::unknown_type; }

class MeasurementSink {
  public:
    virtual ~MeasurementSink() = default;
    /// `input` and `sequence` are filled in by the sink.
    virtual void accept(Timestamp time, const Observation& observation) = 0;
    /// A whole frame was understood, whether or not it held a measurement: its bytes without a line's end or what wraps
    /// a message, valid during the call.
    virtual void frame(std::span<const std::uint8_t> /*bytes*/) {}
    virtual void refuse(Refusal reason) = 0;
};

class Decoder {
  public:
    virtual ~Decoder() = default;
    virtual void decode(const Packet& packet, MeasurementSink& sink) = 0;
    /// Forgets half-received frames: the transport was opened anew.
    virtual void reset() {}
    /// What the device must be asked now, if anything: bytes of a stream, or a CAN frame; valid until the next call.
    /// The input asks after each read, so at least ten times a second; a replay never does.
    virtual std::optional<Packet> request(Timestamp /*now*/) { return std::nullopt; }
};

struct DecoderRow {
    std::string_view name;
    std::string_view about;
    Wire wire;
    OptionTable options;
    std::unique_ptr<Decoder> (*make)(const void* settings);
    bool datagrams = false; ///< a packet is a message, whole in itself
};

std::span<const DecoderRow> decoder_table();
const DecoderRow* find_decoder(std::string_view name);

} // namespace locus
