// J1939 messages longer than a frame that are sent to everyone (BAM): an announcement with size and group, then up to
// 255 numbered frames of 7 bytes. Put together here and not by the kernel, so that a recording of frames replays.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/j1939/identifier.h"

#include <array>
#include <span>
#include <vector>

namespace locus::j1939 {

inline constexpr std::uint32_t announcements = 0xEC00; ///< TP.CM
inline constexpr std::uint32_t transfers = 0xEB00;     ///< TP.DT
inline constexpr std::size_t longest_message = 1785;

/// A message that is whole; the bytes are valid during the call only.
struct Message {
    std::uint32_t group;
    std::uint8_t source;
    Timestamp begun; ///< stamp of the announcement
    std::span<const std::uint8_t> data;
};

class Broadcasts {
  public:
    enum class Outcome : std::uint8_t {
        nothing, ///< not of a broadcast, or of one that was refused before
        kept,    ///< one frame more
        whole,   ///< message() holds it until the next frame
        refused, ///< a message lost, doubled or swapped frames, or paused too long: it is given up, once
    };

    /// Takes one frame with its identifier. A source has one message at a time under way.
    Outcome take(const Identifier& id, const Packet& packet);
    Message message() const;
    void reset();

    static constexpr std::size_t most_sources = 8; ///< at a time; one more takes the place of the longest silent

  private:
    struct Transfer {
        bool under_way = false;
        std::uint8_t source = 0;
        std::uint32_t group = 0;
        std::size_t size = 0;
        std::size_t have = 0;
        std::uint8_t next = 1; ///< number of the frame that is due
        Timestamp begun{};
        Timestamp last{};
        std::array<std::uint8_t, longest_message> data{};
    };

    Transfer* find(std::uint8_t source);
    Transfer& room();
    Outcome announce(std::uint8_t source, const Packet& packet);
    Outcome append(std::uint8_t source, const Packet& packet);

    std::array<Transfer, most_sources> transfers_{};
    const Transfer* whole_ = nullptr;
};

/// The frames of a message of 9 to 1785 bytes to everyone.
std::vector<CanFrame> broadcast(std::uint32_t group, std::uint8_t source, std::span<const std::uint8_t> data,
                                std::uint8_t priority = 7);

} // namespace locus::j1939
