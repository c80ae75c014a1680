// What Nooploop LinkTrack's NLink frames say (protocols.md 2.2), one plain struct a shape of frame. Numbers stay in the
// steps of the wire, which their names tell, so that what is written is what was read.
#pragma once

#include "drivers/uwb/list.h"
#include "drivers/wire/frame_stream.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace locus::uwb::nlink {

/// Marks newer than those of protocols.md may bring roles that are not here.
enum class Role : std::uint8_t { node, anchor, tag, console, master, slave, monitor };
inline constexpr Role last_role = Role::monitor;

/// Second byte of a frame. Of the node frames, 5 and 6 have wide (32-bit) ids.
enum class Mark : std::uint8_t {
    anchor_frame0,
    tag_frame0,
    node_frame0,
    node_frame1,
    node_frame2,
    node_frame3,
    node_frame4,
    aoa_node_frame0,
    node_frame5,
    node_frame6
};

inline constexpr std::uint8_t link_track_sync = 0x55;
inline constexpr std::uint8_t tof_sense_sync = 0x57;
inline constexpr std::uint8_t anchor_frame_end = 0xEE; ///< where other frames have their sum

/// Longest frame that is believed: the longest with fixed elements (255 in nodeframe2) needs 3,435 bytes.
inline constexpr std::size_t max_frame = 4096;

/// Who sends the frame, and when in its own clocks.
struct Sender {
    Role role = Role::node;
    std::uint32_t id = 0;
    std::uint32_t local_time_ms = 0;
    std::uint32_t system_time_ms = 0;
    std::uint16_t voltage_mv = 0;

    bool operator==(const Sender&) const = default;
};

/// What the unit works out of its ranges and its IMU.
struct Motion {
    std::array<std::int32_t, 3> position_mm{};
    std::array<std::int32_t, 3> velocity_tenth_mmps{};
    std::array<std::uint8_t, 3> position_error_cm{}; ///< 255: not known
    std::array<float, 3> angular_rate_radps{};
    std::array<float, 3> specific_force_mps2{};
    std::array<std::int16_t, 3> angle_centidegrees{};
    std::array<float, 4> quaternion{};

    bool operator==(const Motion&) const = default;
};

/// anchorframe0: an anchor or console tells of every tag its distances to anchors 0 to 7. Zero: not measured.
struct AnchorFrame {
    struct Tag {
        std::uint8_t id = 0;
        Role role = Role::tag;
        std::array<std::int32_t, 3> position_mm{};
        std::array<std::uint16_t, 8> distance_cm{};
        bool operator==(const Tag&) const = default;
    };
    static constexpr std::size_t slots = 30;

    Sender sender;
    List<Tag, slots> tags; ///< the slots that are not empty
    bool operator==(const AnchorFrame&) const = default;
};

/// tagframe0: a tag tells its own distances to anchors 0 to 7.
struct TagFrame {
    Sender sender;
    Motion motion;
    std::array<std::int32_t, 8> distance_mm{};
    bool operator==(const TagFrame&) const = default;
};

/// nodeframe1: positions of others.
struct PositionsFrame {
    struct Node {
        Role role = Role::node;
        std::uint8_t id = 0;
        std::array<std::int32_t, 3> position_mm{};
        bool operator==(const Node&) const = default;
    };
    Sender sender;
    List<Node, 255> nodes;
    bool operator==(const PositionsFrame&) const = default;
};

/// nodeframe2, 3, 5 and the AOA frame: ranges from the sender to others.
struct RangesFrame {
    struct Node {
        Role role = Role::node;
        std::uint32_t id = 0;
        std::int32_t distance_mm = 0;
        std::int16_t angle_centidegrees = 0; ///< AOA frame
        std::uint8_t first_path_power = 0;   ///< -0.5 dBm a step
        std::uint8_t received_power = 0;     ///< -0.5 dBm a step
        std::uint32_t system_time_ms = 0;    ///< nodeframe2
        bool operator==(const Node&) const = default;
    };
    Mark mark = Mark::node_frame3;
    Sender sender;
    Motion motion; ///< nodeframe2
    List<Node, 255> nodes;
    bool operator==(const RangesFrame&) const = default;
};

/// nodeframe4: a console tells the ranges of every tag. They follow one another as the tags do.
struct ConsoleFrame {
    struct Range {
        std::uint8_t anchor = 0;
        std::int32_t distance_mm = 0;
        bool operator==(const Range&) const = default;
    };
    struct Tag {
        std::uint8_t id = 0;
        std::uint8_t voltage_20th = 0;
        std::uint8_t ranges = 0; ///< how many of `ranges` are its own
        bool operator==(const Tag&) const = default;
    };
    Sender sender;
    List<Tag, 255> tags;
    List<Range, max_frame / 4> ranges;
    bool operator==(const ConsoleFrame&) const = default;
};

/// nodeframe0 and 6: what users send one another through the radio.
struct DataFrame {
    struct Node {
        Role role = Role::node;
        std::uint32_t id = 0;
        std::span<const std::uint8_t> data; ///< stands in the frame it was read from
        bool operator==(const Node& other) const;
    };
    Mark mark = Mark::node_frame0;
    Role role = Role::node;
    std::uint32_t id = 0;
    List<Node, 255> nodes;
    bool operator==(const DataFrame&) const = default;
};

/// TOFSense: a laser's distance to whatever stands before it.
struct TofSense {
    std::uint8_t id = 0;
    std::uint32_t system_time_ms = 0;
    std::int32_t distance_mm = 0;
    std::uint8_t status = 0;
    std::uint16_t signal_strength = 0;
    std::uint8_t precision = 0;
    bool operator==(const TofSense&) const = default;
};

using Message = std::variant<AnchorFrame, TagFrame, PositionsFrame, RangesFrame, ConsoleFrame, DataFrame, TofSense>;

/// Where frames begin and end, with their checksums.
struct Format {
    static constexpr std::size_t max_length = max_frame;
    static Look look(std::span<const std::uint8_t> bytes);
};

/// Reads one whole frame that Format found. Empty when a count inside it does not fit its length.
std::optional<Message> parse(std::span<const std::uint8_t> frame);

/// The frame with its length and checksum; what is reserved is zero. A message with more than max_frame bytes of data
/// is none that a unit sends.
std::vector<std::uint8_t> encode(const Message& message);

} // namespace locus::uwb::nlink
