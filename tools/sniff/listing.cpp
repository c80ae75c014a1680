#include "tools/sniff/listing.h"

#include <algorithm>
#include <utility>

namespace locus::sniff {
namespace {

constexpr std::size_t most_kept = 2048;
constexpr std::size_t most_refusals = 32; ///< told together; after so many it is time to say something

} // namespace

Listing::Listing(const DecoderRow& decoder, const void* settings, std::uint64_t most_frames, Tell tell)
    : row_{decoder}, decoder_{decoder.make(settings)}, most_frames_{most_frames}, tell_{std::move(tell)} {}

/// Byte by byte, so that what a decoder says is said of a place in the stream. Frames and messages are whole.
void Listing::packet(const Packet& packet) {
    if (packet.wire != row_.wire || full()) return;
    if (packets_++ == 0) begun_ = packet.time;
    if (row_.wire == Wire::can || row_.datagrams) return feed(packet);
    for (std::size_t i = 0; i < packet.data.size() && !full(); ++i) {
        Packet one = packet;
        one.data = packet.data.subspan(i, 1);
        one.time -= static_cast<std::int64_t>(packet.data.size() - 1 - i) * packet.byte_time;
        feed(one);
    }
}

void Listing::feed(const Packet& packet) {
    current_ = packet;
    now_ = packet.time;
    bytes_ += packet.data.size();
    decoder_->decode(packet, *this);
    tell_frame();
    if (row_.wire == Wire::can ? !refusals_.empty() : refusals_.size() >= most_refusals) tell_refusals(0);
    current_.data = {};
}

void Listing::finish() {
    tell_frame();
    if (!refusals_.empty()) tell_refusals(0);
}

Entry Listing::entry(std::span<const std::uint8_t> bytes) const {
    Entry entry;
    entry.time = now_;
    entry.bytes.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), most_kept)));
    entry.wire = row_.wire;
    entry.can_id = current_.can_id;
    return entry;
}

void Listing::frame(std::span<const std::uint8_t> bytes) {
    tell_frame();
    if (!refusals_.empty()) tell_refusals(bytes.size());
    tally_.frame(bytes);
    accounted_ = bytes_;
    frame_ = entry(bytes);
}

void Listing::accept(Timestamp time, const Observation& observation) {
    tally_.accept(time, observation);
    if (!frame_) frame_ = entry({});
    frame_->measurements.push_back({time, 0, 0, observation});
}

void Listing::refuse(Refusal reason) {
    tally_.refuse(reason);
    tell_frame();
    refusals_.push_back(reason);
}

void Listing::tell_frame() {
    if (frame_) tell_(*frame_);
    frame_.reset();
}

/// What lies between the last frame and the `understood` bytes of the one that has just come; the end of its line, if
/// it is one, is neither.
void Listing::tell_refusals(std::size_t understood) {
    const bool can = row_.wire == Wire::can;
    Entry told = entry(can ? current_.data : std::span<const std::uint8_t>{});
    const std::uint64_t passed = bytes_ - accounted_;
    const bool line_end = !can && understood > 0 && !current_.data.empty() && current_.data.back() == '\n';
    const std::uint64_t taken = understood + (line_end ? 1 : 0);
    told.skipped = passed > taken ? passed - taken : 0;
    told.refusals = std::exchange(refusals_, {});
    skipped_ += told.skipped;
    accounted_ = bytes_;
    tell_(told);
}

} // namespace locus::sniff
