// Good frames of every decoder, one file a family: what the throughput benchmark, the allocation test and the
// resynchronisation test feed. A row of the decoder table without examples fails these tests.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/decoder.h"

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace locus::examples {

using Chunk = std::vector<std::uint8_t>;

struct DecoderExample {
    std::string_view decoder;        ///< name in the decoder table
    std::vector<Chunk> chunks{};     ///< byte formats: each is whole in itself and gives at least one measurement
    std::vector<CanFrame> frames{};  ///< CAN formats: in this order, together they give measurements
    bool lines = false;              ///< a frame is a line of text: damage without a newline costs the line after it
    bool datagrams = false;          ///< a packet is a message: it cannot be cut, nor be damaged but as a whole
    bool checksum = true;            ///< bytes chunks are guarded: of damage nothing comes but a refusal
    bool weak = false;               ///< by 8 bits only: of 256 damages one looks intact
    Duration apart{};                ///< bytes formats that tell damage by silence: the time between chunks
    std::vector<CanFrame> rubbish{}; ///< CAN formats: frames that it must refuse

    /// With its default settings, unless `settings` gives others.
    std::unique_ptr<Decoder> make() const;
    std::shared_ptr<void> settings{};
};

/// What gtest prints of one.
inline void PrintTo(const DecoderExample& example, std::ostream* out) { *out << example.decoder; }

/// Every family's examples, in the order of the table in table.cpp.
const std::vector<DecoderExample>& all();

inline Chunk chunk(std::string_view text) { return {text.begin(), text.end()}; }

/// "A5 01ff" as bytes; for frames as the protocol page prints them.
Chunk from_hex(std::string_view hex);

} // namespace locus::examples
