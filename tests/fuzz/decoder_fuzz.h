// What every decoder must keep to, whatever bytes come: finite values, and the same result however a stream is cut.
#pragma once

#include "drivers/decoder.h"
#include "drivers/recording/measurement_json.h"
#include "tests/examples/decoder_example.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace locus::fuzz {

struct Result : MeasurementSink {
    std::vector<std::string> lines;
    std::size_t frames = 0, refusals = 0;

    void accept(Timestamp time, const Observation& observation) override {
        const std::string line = to_json_line({time, 0, 0, observation});
        std::string error;
        if (!from_json_line(line, error)) std::abort(); // left out because it is not finite
        lines.push_back(line);
    }
    void frame(std::span<const std::uint8_t> /*bytes*/) override { ++frames; }
    void refuse(Refusal reason) override {
        if (reason >= Refusal::count_) std::abort();
        ++refusals;
    }
    bool operator==(const Result& other) const {
        return lines == other.lines && frames == other.frames && refusals == other.refusals;
    }
};

using examples::DecoderExample;

/// Feeds the bytes in chunks of `size`.
inline Result run_bytes(const DecoderExample& device, std::span<const std::uint8_t> bytes, std::size_t size) {
    Result result;
    const auto fresh = device.make();
    while (!bytes.empty()) {
        Packet packet;
        packet.data = bytes.first(std::min(size, bytes.size()));
        fresh->decode(packet, result);
        bytes = bytes.subspan(packet.data.size());
    }
    return result;
}

/// Any stream: whole, byte by byte, and in chunks of seven gives the same. A datagram is whole.
inline void check_bytes(const DecoderExample& device, std::span<const std::uint8_t> bytes) {
    const Result whole = run_bytes(device, bytes, std::max<std::size_t>(bytes.size(), 1));
    if (device.datagrams) return;
    if (!(run_bytes(device, bytes, 1) == whole) || !(run_bytes(device, bytes, 7) == whole)) std::abort();
}

/// The input as a row of CAN frames: id (2 bytes), 4 bits of length, 4 bits of milliseconds since the one before, data.
inline void check_can(const DecoderExample& device, std::span<const std::uint8_t> bytes) {
    Result result;
    const auto fresh = device.make();
    Packet packet;
    packet.wire = Wire::can;
    while (bytes.size() >= 3) {
        packet.can_id = static_cast<std::uint32_t>(bytes[0] | (bytes[1] & 7) << 8) |
                        static_cast<std::uint32_t>(bytes[1] >> 5) << 29; // EFF, RTR, ERR
        packet.time += std::chrono::milliseconds{bytes[2] >> 4};
        packet.data = bytes.subspan(3).first(std::min<std::size_t>(bytes[2] & 15, bytes.size() - 3));
        fresh->decode(packet, result);
        bytes = bytes.subspan(3 + packet.data.size());
    }
}

/// Through every example of that name: they differ in their settings.
inline void check(std::string_view name, std::span<const std::uint8_t> bytes) {
    for (const DecoderExample& device : examples::all()) {
        if (device.decoder != name) continue;
        find_decoder(name)->wire == Wire::can ? check_can(device, bytes) : check_bytes(device, bytes);
    }
}

} // namespace locus::fuzz
