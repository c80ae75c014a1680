#include "drivers/j1939/broadcasts.h"

#include "drivers/wire/bytes.h"

#include <algorithm>

namespace locus::j1939 {
namespace {

constexpr std::size_t frame_size = 8;
constexpr std::size_t bytes_a_frame = 7; // behind the number
constexpr std::uint8_t broadcast_control = 0x20;
constexpr std::size_t shortest_message = 9;                        // what is shorter goes into one frame
constexpr Duration longest_pause = std::chrono::milliseconds{750}; // T1 of J1939-21

constexpr std::size_t frames_for(std::size_t size) { return (size + bytes_a_frame - 1) / bytes_a_frame; }

} // namespace

Broadcasts::Outcome Broadcasts::take(const Identifier& id, const Packet& packet) {
    whole_ = nullptr;
    if (id.destination != everyone) return Outcome::nothing;
    if (id.group == announcements) return announce(id.source, packet);
    return id.group == transfers ? append(id.source, packet) : Outcome::nothing;
}

Message Broadcasts::message() const {
    return {whole_->group, whole_->source, whole_->begun, std::span{whole_->data}.first(whole_->size)};
}

void Broadcasts::reset() {
    for (Transfer& transfer : transfers_) transfer.under_way = false;
    whole_ = nullptr;
}

Broadcasts::Transfer* Broadcasts::find(std::uint8_t source) {
    auto* const found = std::ranges::find_if(
        transfers_, [&](const Transfer& transfer) { return transfer.under_way && transfer.source == source; });
    return found == transfers_.end() ? nullptr : found;
}

Broadcasts::Transfer& Broadcasts::room() {
    return *std::ranges::min_element(
        transfers_, {}, [](const Transfer& transfer) { return transfer.under_way ? transfer.last : Timestamp::min(); });
}

Broadcasts::Outcome Broadcasts::announce(std::uint8_t source, const Packet& packet) {
    if (packet.data.empty() || packet.data[0] != broadcast_control) return Outcome::nothing;
    Transfer* const unfinished = find(source);
    if (unfinished) unfinished->under_way = false;
    const auto size = wire::little<std::uint16_t>(packet.data, 1);
    const bool sane = packet.data.size() == frame_size && size >= shortest_message && size <= longest_message &&
                      packet.data[3] == frames_for(size);
    if (!sane) return Outcome::refused;
    Transfer& transfer = unfinished ? *unfinished : room();
    const bool lost = unfinished || transfer.under_way;
    transfer.under_way = true;
    transfer.source = source;
    transfer.group = static_cast<std::uint32_t>(wire::little_bytes(packet.data, 5, 3));
    transfer.size = size;
    transfer.have = 0;
    transfer.next = 1;
    transfer.begun = transfer.last = packet.time;
    return lost ? Outcome::refused : Outcome::kept;
}

Broadcasts::Outcome Broadcasts::append(std::uint8_t source, const Packet& packet) {
    Transfer* const transfer = find(source);
    const std::uint8_t number = packet.data.empty() ? std::uint8_t{0} : packet.data[0];
    if (!transfer) return number == 1 ? Outcome::refused : Outcome::nothing; // 1: the announcement was lost
    const std::size_t due = std::min(bytes_a_frame, transfer->size - transfer->have);
    const bool fits = number == transfer->next && packet.data.size() > due && packet.data.size() <= frame_size &&
                      packet.time - transfer->last <= longest_pause;
    transfer->under_way = fits;
    if (!fits) return Outcome::refused;
    std::ranges::copy(packet.data.subspan(1, due),
                      transfer->data.begin() + static_cast<std::ptrdiff_t>(transfer->have));
    transfer->have += due;
    transfer->last = packet.time;
    ++transfer->next;
    if (transfer->have < transfer->size) return Outcome::kept;
    transfer->under_way = false;
    whole_ = transfer;
    return Outcome::whole;
}

std::vector<CanFrame> broadcast(std::uint32_t group, std::uint8_t source, std::span<const std::uint8_t> data,
                                std::uint8_t priority) {
    const auto count = static_cast<std::uint8_t>(frames_for(data.size()));
    const auto byte = [](std::size_t value) { return static_cast<std::uint8_t>(value); };
    std::vector<CanFrame> frames{{can_id({priority, announcements, source, everyone}),
                                  frame_size,
                                  {broadcast_control, byte(data.size()), byte(data.size() >> 8), count, 0xFF,
                                   byte(group), byte(group >> 8), byte(group >> 16)}}};
    for (std::uint8_t number = 1; number <= count && !data.empty(); ++number) {
        CanFrame& frame =
            frames.emplace_back(CanFrame{can_id({priority, transfers, source, everyone}), frame_size, {}});
        frame.data.fill(0xFF);
        frame.data[0] = number;
        const auto part = data.first(std::min(bytes_a_frame, data.size()));
        std::ranges::copy(part, frame.data.begin() + 1);
        data = data.subspan(part.size());
    }
    return frames;
}

} // namespace locus::j1939
