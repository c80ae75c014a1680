// NLink frames read and written through nlink_layout.h.
#include "drivers/uwb/nlink_layout.h"
#include "drivers/wire/checksum.h"

namespace locus::uwb::nlink {
namespace {

constexpr std::uint8_t empty_slot = 0xFF;
constexpr std::size_t envelope = 5; // sync, mark, length, sum

/// What reader and writer do with a frame behind its sync and mark.
template <class Io>
struct Fields {
    Io& io;
    void operator()(TagFrame& frame) const { tag_frame(io, frame); }
    void operator()(PositionsFrame& frame) const { positions_frame(io, frame); }
    void operator()(RangesFrame& frame) const { ranges_frame(io, frame); }
    void operator()(ConsoleFrame& frame) const { console_frame(io, frame); }
    void operator()(DataFrame& frame) const { data_frame(io, frame); }
    void operator()(TofSense& sense) const { tof_sense(io, sense); }
    void operator()(AnchorFrame& frame) const {
        for (std::size_t i = 0; i < AnchorFrame::slots; ++i) one_slot(frame, i);
        anchor_tail(io, frame.sender);
    }

  private:
    void one_slot(AnchorFrame& frame, std::size_t i) const {
        AnchorFrame::Tag tag;
        if (i < frame.tags.size()) tag = frame.tags[i];
        if constexpr (std::is_same_v<Io, Writer>) {
            if (i >= frame.tags.size()) tag.id = empty_slot;
            slot(io, tag);
        } else {
            slot(io, tag);
            if (tag.id != empty_slot) frame.tags.push_back(tag);
        }
    }
};

bool plausible(const Message& message) {
    const auto* frame = std::get_if<AnchorFrame>(&message);
    return frame == nullptr ||
           (frame->sender.role <= last_role &&
            std::ranges::all_of(frame->tags, [](const auto& tag) { return tag.role <= last_role; }));
}

std::optional<Message> read(Message message, wire::Bytes fields) {
    Reader reader{fields};
    std::visit(Fields<Reader>{reader}, message);
    if (!reader.whole() || !plausible(message)) return std::nullopt;
    return message;
}

Message empty(Mark mark) {
    switch (mark) {
    case Mark::anchor_frame0:
        return AnchorFrame{};
    case Mark::tag_frame0:
        return TagFrame{};
    case Mark::node_frame1:
        return PositionsFrame{};
    case Mark::node_frame4:
        return ConsoleFrame{};
    case Mark::node_frame0:
    case Mark::node_frame6:
        return DataFrame{mark, {}, {}, {}};
    default:
        return RangesFrame{mark, {}, {}, {}};
    }
}

std::vector<std::uint8_t> with_sum(std::vector<std::uint8_t> frame) {
    frame.push_back(wire::sum8(frame));
    return frame;
}

std::vector<std::uint8_t> framed(Mark mark, const std::vector<std::uint8_t>& fields) {
    wire::Writer out;
    out.little(link_track_sync).little(static_cast<std::uint8_t>(mark));
    if (mark > Mark::tag_frame0) out.little(static_cast<std::uint16_t>(fields.size() + envelope));
    out.bytes(fields);
    if (mark != Mark::anchor_frame0) return with_sum(out.take());
    return out.little(anchor_frame_end).take();
}

struct MarkOf {
    Mark operator()(const AnchorFrame&) const { return Mark::anchor_frame0; }
    Mark operator()(const TagFrame&) const { return Mark::tag_frame0; }
    Mark operator()(const PositionsFrame&) const { return Mark::node_frame1; }
    Mark operator()(const RangesFrame& frame) const { return frame.mark; }
    Mark operator()(const ConsoleFrame&) const { return Mark::node_frame4; }
    Mark operator()(const DataFrame& frame) const { return frame.mark; }
    Mark operator()(const TofSense&) const { return {}; } // it has its own sync
};

} // namespace

bool DataFrame::Node::operator==(const Node& other) const {
    return role == other.role && id == other.id && std::ranges::equal(data, other.data);
}

std::optional<Message> parse(std::span<const std::uint8_t> frame) {
    if (frame.size() < envelope) return std::nullopt;
    const auto mark = static_cast<Mark>(frame[1]);
    const auto fields = frame.first(frame.size() - 1).subspan(mark > Mark::tag_frame0 ? 4 : 2);
    if (frame[0] == tof_sense_sync) return read(TofSense{}, fields);
    if (frame[0] != link_track_sync || mark > Mark::node_frame6) return std::nullopt;
    return read(empty(mark), fields);
}

std::vector<std::uint8_t> encode(const Message& message) {
    Message copy = message;
    Writer writer;
    std::visit(Fields<Writer>{writer}, copy);
    if (!std::holds_alternative<TofSense>(message)) return framed(std::visit(MarkOf{}, message), writer.take());
    wire::Writer out;
    out.little(tof_sense_sync).zeros(1).bytes(writer.take());
    return with_sum(out.take());
}

} // namespace locus::uwb::nlink
