// Messages of a PulsON P4xx radio (RCM and RangeNet) as protocols.md 3.3 has them: one struct a message, read and
// written by layout.h. Names of lengths and errors carry their unit; an error is one standard deviation.
#pragma once

#include "drivers/uwb/pulson/layout.h"

#include <array>
#include <cstdint>

namespace locus::uwb::pulson {

using Types = std::array<std::uint16_t, 1>;

/// Bits of `parts`: which of a message's ranges were measured.
enum Part : std::uint8_t { precise = 1, coarse = 2, filtered = 4 };

/// Range status; 0, 1, 3, 5, 7, 9 and 11 stand alone, the others are bits.
enum Status : std::uint8_t {
    success = 0,
    timeout = 1,
    requester_edge_failed = 2,
    busy = 3,
    responder_edge_failed = 4,
    requester_hears_weakly = 5,
    responder_hears_weakly = 7,
    co_channel_interference = 9,
    line_of_sight_mismatch = 11,
    too_long = 32,
    coarse_update = 64,
};

/// Flags of the leading-edge detection at one end.
enum Edge : std::uint16_t { saturated = 1, window_short = 2, weak = 4, line_of_sight = 8, no_line_of_sight = 16 };

inline constexpr std::uint8_t default_antenna = 0xFF;

/// RCM_SEND_RANGE_REQUEST.
struct RangeRequest {
    static constexpr Types types{0x0003};
    std::uint16_t type = types[0];
    std::uint16_t message = 0; ///< comes back in the confirm and in the range
    std::uint32_t responder = 0;
    std::uint8_t antenna = default_antenna;
    std::uint16_t data_size = 0;
    wire::Bytes data{};

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.responder, m.antenna, Reserved{1}, m.data_size, Tail{m.data, m.data_size, 1});
    }
};

/// What the radio answers to a request at once; status 0: accepted.
struct Confirm {
    static constexpr std::array<std::uint16_t, 5> types{0x0103, 0x0101, 0x0104, 0x0105, 0x0106};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint32_t status = 0;

    static void layout(auto& fields, auto& m) { fields(m.type, m.message, m.status); }
    bool operator==(const Confirm&) const = default;
};

/// RCM_FULL_RANGE_INFO: how a conversation went that this radio began, or (status coarse_update) one it overheard.
struct FullRange {
    static constexpr Types types{0x0201};
    std::uint16_t type = types[0];
    std::uint16_t message = 0; ///< of the request
    std::uint32_t responder = 0;
    std::uint8_t status = success;
    std::uint8_t antenna = 0; ///< low nibble requester, high nibble responder
    std::uint16_t stopwatch_ms = 0;
    std::uint32_t precise_mm = 0;
    std::uint32_t coarse_mm = 0;
    std::uint32_t filtered_mm = 0;
    std::uint16_t precise_sigma_mm = 0;
    std::uint16_t coarse_sigma_mm = 0;
    std::uint16_t filtered_sigma_mm = 0;
    std::int16_t velocity_mmps = 0;
    std::uint16_t velocity_sigma_mmps = 0;
    std::uint8_t parts = 0;
    std::uint16_t requester_edge = 0;
    std::uint16_t responder_edge = 0;
    std::uint16_t noise = 0;
    std::uint16_t peak = 0;
    std::int32_t coarse_flight_bins = 0; ///< of 61 ps
    std::uint32_t timestamp = 0;         ///< ms since boot; in a TDMA network us of the network's clock

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.responder, m.status, m.antenna, m.stopwatch_ms, m.precise_mm, m.coarse_mm,
               m.filtered_mm, m.precise_sigma_mm, m.coarse_sigma_mm, m.filtered_sigma_mm, m.velocity_mmps,
               m.velocity_sigma_mmps, m.parts, Reserved{1}, m.requester_edge, m.responder_edge, m.noise, m.peak,
               m.coarse_flight_bins, m.timestamp);
    }
    bool operator==(const FullRange&) const = default;
};

/// RCM_SMALL_RANGE_INFO. The vendor's header gives it the first type, his specification the second.
struct SmallRange {
    static constexpr std::array<std::uint16_t, 2> types{0x0205, 0x3201};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint32_t responder = 0;
    std::uint16_t range_cm = 0;
    std::uint8_t sigma_cm = 0;
    std::uint8_t parts = 0;
    std::uint8_t status = success;
    std::uint8_t flags = 0;

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.responder, m.range_cm, m.sigma_cm, m.parts, m.status, m.flags);
    }
    bool operator==(const SmallRange&) const = default;
};

/// RCM_ECHOED_RANGE_INFO: the last precise range of another radio, which it repeats in its requests.
struct EchoedRange {
    static constexpr Types types{0x0204};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint32_t requester = 0;
    std::uint32_t responder = 0;
    std::uint32_t precise_mm = 0;
    std::uint16_t precise_sigma_mm = 0;
    std::uint16_t edges = 0;     ///< of both ends, or-ed
    std::uint32_t timestamp = 0; ///< ms since the requester's boot; the same again: the same range again

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.requester, m.responder, m.precise_mm, m.precise_sigma_mm, m.edges, m.timestamp);
    }
    bool operator==(const EchoedRange&) const = default;
};

/// RCM_DATA_INFO: data that came over the air.
struct DataInfo {
    static constexpr Types types{0x0202};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint32_t source = 0;
    std::uint16_t noise = 0;
    std::uint16_t peak = 0;
    std::uint32_t timestamp_ms = 0;
    std::uint8_t antenna = 0;
    std::uint16_t data_size = 0;
    wire::Bytes data{};

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.source, m.noise, m.peak, m.timestamp_ms, m.antenna, Reserved{1}, m.data_size,
               Tail{m.data, m.data_size, 1});
    }
};

/// RCM_SCAN_INFO: a waveform around its leading edge.
struct ScanInfo {
    static constexpr Types types{0x0203};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint32_t source = 0;
    std::uint8_t antenna = 0;
    std::uint16_t edge = 0;
    std::uint16_t noise = 0;
    std::uint16_t peak = 0;
    std::uint32_t timestamp_ms = 0;
    std::int32_t leading_edge = 0;
    std::int32_t lock_spot = 0;
    std::uint32_t sample_count = 0;
    wire::Bytes samples{}; ///< i32 each

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.source, m.antenna, Reserved{1}, m.edge, m.noise, m.peak, m.timestamp_ms,
               m.leading_edge, m.lock_spot, m.sample_count, Tail{m.samples, m.sample_count, 4});
    }
};

/// RCM_FULL_SCAN_INFO: one message of several that make a waveform. Always room for 350 samples.
struct FullScan {
    static constexpr Types types{0xF201};
    static constexpr std::uint16_t room = 350;
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint32_t source = 0;
    std::uint32_t timestamp_ms = 0;
    std::uint16_t noise = 0;
    std::uint16_t peak = 0;
    std::int32_t leading_edge = 0;
    std::int32_t lock_spot = 0;
    std::int32_t start_ps = 0;
    std::int32_t stop_ps = 0;
    std::uint16_t step_bins = 0;
    std::uint8_t filtering = 0;
    std::uint8_t antenna = 0;
    std::uint8_t operation_mode = 0;
    std::uint16_t samples_here = 0; ///< as said: may lie
    std::uint32_t samples_in_all = 0;
    std::uint16_t part = 0;
    std::uint16_t parts = 0;
    wire::Bytes samples{}; ///< i32 each

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.source, m.timestamp_ms, m.noise, m.peak, Reserved{4}, m.leading_edge, m.lock_spot,
               m.start_ps, m.stop_ps, m.step_bins, m.filtering, Reserved{1}, m.antenna, m.operation_mode,
               m.samples_here, m.samples_in_all, m.part, m.parts, Tail{m.samples, room, 4});
    }
};

} // namespace locus::uwb::pulson
