// A sink that keeps what a decoder gave, and feeds it bytes or CAN frames.
#pragma once

#include "drivers/decoder.h"

#include <string_view>
#include <vector>

namespace locus::test {

struct Collector : MeasurementSink {
    struct Item {
        Timestamp time;
        Observation observation;
    };
    std::vector<Item> items;
    std::vector<Refusal> refusals;
    int frames = 0;

    void accept(Timestamp time, const Observation& observation) override { items.push_back({time, observation}); }
    void frame(std::span<const std::uint8_t> /*bytes*/) override { ++frames; }
    void refuse(Refusal reason) override { refusals.push_back(reason); }

    template <class Kind>
    std::vector<Kind> all() const {
        std::vector<Kind> kinds;
        for (const Item& item : items) kinds.push_back(std::get<Kind>(item.observation));
        return kinds;
    }
};

inline Packet bytes_packet(std::span<const std::uint8_t> bytes, Timestamp time = {}, Duration byte_time = {}) {
    Packet packet;
    packet.time = time;
    packet.byte_time = byte_time;
    packet.data = bytes;
    return packet;
}

inline Packet bytes_packet(std::string_view text, Timestamp time = {}, Duration byte_time = {}) {
    return bytes_packet(std::span{reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, time, byte_time);
}

/// A decoder of the table with its default settings.
inline std::unique_ptr<Decoder> default_decoder(std::string_view name) {
    const DecoderRow* row = find_decoder(name);
    return row == nullptr ? nullptr : row->make(row->options.make().get());
}

} // namespace locus::test
