// Lines of text out of the chunks that a serial line gives: bounded, and each line with the time it was complete.
#pragma once

#include "drivers/packet.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace locus {

class LineSplitter {
  public:
    static constexpr std::size_t capacity = 512; ///< longest line kept, without its end

    /// Calls on_line(std::string_view line, Timestamp complete) for each line that ends in the packet, without its
    /// "\n" or "\r\n"; empty lines are skipped. A line that is too long is given up, up to the next newline, with one
    /// call of on_too_long(). The view is valid during the call only.
    template <class OnLine, class OnTooLong>
    void feed(const Packet& packet, const OnLine& on_line, const OnTooLong& on_too_long) {
        for (std::size_t i = 0; i < packet.data.size(); ++i) {
            if (const auto byte = static_cast<char>(packet.data[i]); byte != '\n') {
                if (!keep(byte)) on_too_long();
                continue;
            }
            const auto after = static_cast<std::int64_t>(packet.data.size() - 1 - i);
            if (const std::string_view line = finished(); !line.empty())
                on_line(line, packet.time - after * packet.byte_time);
            reset();
        }
    }

    /// Forgets a half-received line.
    void reset() {
        length_ = 0;
        skipping_ = false;
    }

  private:
    std::array<char, capacity> buffer_{};
    std::size_t length_ = 0;
    bool skipping_ = false; ///< the line was too long: nothing of it counts until its end

    /// False at the byte that makes the line too long.
    bool keep(char byte) {
        if (skipping_) return true;
        if (length_ == capacity) {
            skipping_ = true;
            return false;
        }
        buffer_[length_++] = byte;
        return true;
    }

    std::string_view finished() const {
        if (skipping_) return {};
        const std::size_t carriage_return = length_ > 0 && buffer_[length_ - 1] == '\r';
        return {buffer_.data(), length_ - carriage_return};
    }
};

} // namespace locus
