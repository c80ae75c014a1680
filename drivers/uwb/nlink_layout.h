// Order and width of the fields in NLink frames, said once: the Reader and the Writer of nlink_io.h both go through it.
#pragma once

#include "drivers/uwb/nlink_io.h"

namespace locus::uwb::nlink {

template <class Io, class T, std::size_t count>
void numbers(Io& io, std::array<T, count>& values) {
    for (T& value : values) io.number(value);
}
template <class Io, class T, std::size_t count>
void int24s(Io& io, std::array<T, count>& values) {
    for (T& value : values) io.int24(value);
}

/// One byte, but four in the frames that came last.
template <class Io>
void identity(Io& io, Mark mark, std::uint32_t& id) {
    if (mark == Mark::node_frame5 || mark == Mark::node_frame6) return io.number(id);
    auto narrow = static_cast<std::uint8_t>(id);
    io.number(narrow);
    id = narrow;
}

/// Behind role and length, up to the list: nodeframe3, 4, 5 and AOA.
template <class Io>
void head(Io& io, Mark mark, Sender& sender) {
    io.number(sender.role);
    identity(io, mark, sender.id);
    io.number(sender.local_time_ms);
    io.number(sender.system_time_ms);
    io.skip(4);
    io.number(sender.voltage_mv);
}

template <class Io>
void inertial(Io& io, Motion& motion) {
    numbers(io, motion.angular_rate_radps);
    numbers(io, motion.specific_force_mps2);
    io.skip(12);
    numbers(io, motion.angle_centidegrees);
    numbers(io, motion.quaternion);
    io.skip(4);
}

/// One slot of anchorframe0.
template <class Io>
void slot(Io& io, AnchorFrame::Tag& tag) {
    io.number(tag.id);
    io.number(tag.role);
    int24s(io, tag.position_mm);
    numbers(io, tag.distance_cm);
}

/// anchorframe0 behind its slots.
template <class Io>
void anchor_tail(Io& io, Sender& sender) {
    io.skip(67);
    io.number(sender.local_time_ms);
    io.skip(4);
    io.number(sender.voltage_mv);
    io.number(sender.system_time_ms);
    identity(io, Mark::anchor_frame0, sender.id);
    io.number(sender.role);
}

template <class Io>
void tag_frame(Io& io, TagFrame& frame) {
    identity(io, Mark::tag_frame0, frame.sender.id);
    io.number(frame.sender.role);
    int24s(io, frame.motion.position_mm);
    int24s(io, frame.motion.velocity_tenth_mmps);
    int24s(io, frame.distance_mm);
    inertial(io, frame.motion);
    io.number(frame.sender.local_time_ms);
    io.number(frame.sender.system_time_ms);
    io.skip(1);
    numbers(io, frame.motion.position_error_cm);
    io.number(frame.sender.voltage_mv);
    io.skip(5);
}

template <class Io>
void positions_frame(Io& io, PositionsFrame& frame) {
    io.number(frame.sender.role);
    identity(io, Mark::node_frame1, frame.sender.id);
    io.number(frame.sender.system_time_ms);
    io.number(frame.sender.local_time_ms);
    io.skip(10);
    io.number(frame.sender.voltage_mv);
    io.list(frame.nodes, [&io](PositionsFrame::Node& node) {
        io.number(node.role);
        io.number(node.id);
        int24s(io, node.position_mm);
        io.skip(9);
    });
}

/// nodeframe2, up to its list: here system and local time stand apart, and the motion between.
template <class Io>
void motion_head(Io& io, RangesFrame& frame) {
    io.number(frame.sender.role);
    identity(io, frame.mark, frame.sender.id);
    io.number(frame.sender.system_time_ms);
    numbers(io, frame.motion.position_error_cm);
    int24s(io, frame.motion.position_mm);
    int24s(io, frame.motion.velocity_tenth_mmps);
    io.skip(9);
    inertial(io, frame.motion);
    io.number(frame.sender.local_time_ms);
    io.skip(10);
    io.number(frame.sender.voltage_mv);
}

template <class Io>
void ranges_frame(Io& io, RangesFrame& frame) {
    if (frame.mark == Mark::node_frame2)
        motion_head(io, frame);
    else
        head(io, frame.mark, frame.sender);
    io.list(frame.nodes, [&io, mark = frame.mark](RangesFrame::Node& node) {
        io.number(node.role);
        identity(io, mark, node.id);
        io.int24(node.distance_mm);
        if (mark == Mark::aoa_node_frame0) io.number(node.angle_centidegrees);
        io.number(node.first_path_power);
        io.number(node.received_power);
        if (mark == Mark::node_frame2) io.number(node.system_time_ms);
        if (mark == Mark::node_frame2 || mark == Mark::aoa_node_frame0) io.skip(2);
    });
}

template <class Io>
void console_frame(Io& io, ConsoleFrame& frame) {
    head(io, Mark::node_frame4, frame.sender);
    std::size_t at = 0;
    io.list(frame.tags, [&](ConsoleFrame::Tag& tag) {
        io.number(tag.id);
        io.skip(2);
        io.number(tag.voltage_20th);
        io.number(tag.ranges);
        io.room(frame.ranges, at + tag.ranges);
        for (const std::size_t end = std::min(at + tag.ranges, frame.ranges.size()); at < end; ++at) {
            io.number(frame.ranges[at].anchor);
            io.int24(frame.ranges[at].distance_mm);
        }
    });
}

template <class Io>
void data_frame(Io& io, DataFrame& frame) {
    io.number(frame.role);
    identity(io, frame.mark, frame.id);
    io.skip(4);
    io.list(frame.nodes, [&io, mark = frame.mark](DataFrame::Node& node) {
        io.number(node.role);
        identity(io, mark, node.id);
        io.data(node.data);
    });
}

template <class Io>
void tof_sense(Io& io, TofSense& sense) {
    io.skip(1);
    io.number(sense.id);
    io.number(sense.system_time_ms);
    io.int24(sense.distance_mm);
    io.number(sense.status);
    io.number(sense.signal_strength);
    io.number(sense.precision);
}

} // namespace locus::uwb::nlink
