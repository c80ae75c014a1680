// The fields of an RTCM 3 message, one after the other. What lies beyond the end reads as 0: a reader of a message
// checks its length first, and a mistake there must not become a read of foreign memory.
#pragma once

#include "drivers/wire/bytes.h"

namespace locus::gnss::rtcm3 {

class Bits {
  public:
    explicit constexpr Bits(wire::Bytes message) : message_{message} {}

    constexpr std::size_t left() const { return at_ < 8 * message_.size() ? 8 * message_.size() - at_ : 0; }
    constexpr Bits& skip(std::size_t count) {
        at_ += count;
        return *this;
    }

    /// The next `count` bits, 1 to 64.
    constexpr std::uint64_t take(std::size_t count) {
        std::uint64_t value = 0;
        for (const std::size_t end = at_ + count; at_ < end; ++at_) value = value << 1 | bit(at_);
        return value;
    }
    constexpr std::int64_t take_signed(unsigned count) { return wire::sign_extended(take(count), count); }

  private:
    constexpr std::uint64_t bit(std::size_t at) const {
        return at / 8 < message_.size() ? message_[at / 8] >> (7 - at % 8) & 1u : 0u;
    }

    wire::Bytes message_;
    std::size_t at_ = 0;
};

} // namespace locus::gnss::rtcm3
