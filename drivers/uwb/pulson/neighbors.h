// RangeNet's neighbour databases (protocols.md 3.3): what a radio knows of every other that it hears, with the newest
// range to each and when it was measured.
#pragma once

#include "drivers/uwb/pulson/layout.h"

#include <array>
#include <cstdint>

namespace locus::uwb::pulson {

struct FullNeighbor {
    std::uint32_t node = 0;
    std::uint8_t status = 0; ///< enum Status
    std::uint8_t antenna = 0;
    std::uint16_t stopwatch_ms = 0;
    std::uint32_t range_mm = 0;
    std::uint16_t sigma_mm = 0;
    std::int16_t velocity_mmps = 0;
    std::uint8_t parts = 0; ///< which kind of range it is
    std::uint8_t flags = 0; ///< 1 beacon, 2 must not be ranged to, 4 excluded, 8 not calibrated
    std::uint16_t edges = 0;
    std::uint16_t noise = 0;
    std::uint16_t peak = 0;
    std::uint16_t attempts = 0;
    std::uint16_t successes = 0;
    std::uint32_t statistics_age_ms = 0;
    std::uint32_t ranged_ms = 0; ///< this and the next two: time since boot
    std::uint32_t heard_ms = 0;
    std::uint32_t added_ms = 0;

    static void layout(auto& fields, auto& m) {
        fields(m.node, m.status, m.antenna, m.stopwatch_ms, m.range_mm, m.sigma_mm, m.velocity_mmps, m.parts, m.flags,
               m.edges, m.noise, m.peak, m.attempts, m.successes, m.statistics_age_ms, m.ranged_ms, m.heard_ms,
               m.added_ms);
    }
    bool operator==(const FullNeighbor&) const = default;
};

/// RN_FULL_NEIGHBOR_DATABASE, as asked for and as sent by itself.
struct FullNeighbors {
    static constexpr std::array<std::uint16_t, 2> types{0x3203, 0x3105};
    static constexpr std::size_t room = 32;
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint8_t count = 0;
    std::uint8_t sort = 0;
    std::uint32_t timestamp_ms = 0; ///< since boot
    std::uint32_t status = 0;
    std::array<FullNeighbor, room> neighbors{};

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.count, m.sort, Reserved{2}, m.timestamp_ms, m.status,
               Counted{m.neighbors, m.count});
    }
    bool operator==(const FullNeighbors&) const = default;
};

struct SmallNeighbor {
    std::uint32_t node = 0;
    std::uint16_t range_cm = 0;
    std::uint8_t sigma_cm = 0;
    std::uint16_t age_ms = 0;
    std::uint8_t parts = 0;
    std::uint8_t flags = 0;

    static void layout(auto& fields, auto& m) {
        fields(m.node, m.range_cm, m.sigma_cm, Reserved{1}, m.age_ms, m.parts, m.flags);
    }
    bool operator==(const SmallNeighbor&) const = default;
};

/// RN_SMALL_NEIGHBOR_DATABASE, as asked for and as sent by itself.
struct SmallNeighbors {
    static constexpr std::array<std::uint16_t, 2> types{0x3204, 0x3106};
    static constexpr std::size_t room = 80;
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint8_t count = 0;
    std::uint8_t sort = 0;
    std::array<SmallNeighbor, room> neighbors{};

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.count, m.sort, Reserved{2}, Counted{m.neighbors, m.count});
    }
    bool operator==(const SmallNeighbors&) const = default;
};

} // namespace locus::uwb::pulson
