// Replies of a DWM1001 to loc_get, found, read and written: layout in dwm1001_tlv.h.
#include "drivers/uwb/dwm1001_tlv.h"
#include "drivers/wire/bytes.h"

#include <algorithm>

namespace locus::uwb::dwm1001 {
namespace {

constexpr std::uint8_t status_type = 0x40, position_type = 0x41, of_anchor_type = 0x48, of_tag_type = 0x49;
constexpr std::uint8_t last_error = 5;
constexpr std::size_t status_size = 3, position_size = 13, distance_size = 13, placed_distance_size = 20;
constexpr std::size_t list_at = position_reply_size; ///< where 0x48 or 0x49 stands

bool good(const TlvReply& reply) {
    const auto percent = [](const TlvDistance& d) {
        return d.quality_percent <= 100 && d.position.quality_percent <= 100;
    };
    return reply.position.quality_percent <= 100 && std::ranges::all_of(reply.distances, percent);
}

TlvPosition read_position(wire::Bytes bytes, std::size_t at) {
    TlvPosition position;
    for (std::size_t i = 0; i < 3; ++i) position.position_mm[i] = wire::little<std::int32_t>(bytes, at + 4 * i);
    position.quality_percent = wire::little<std::uint8_t>(bytes, at + 12);
    return position;
}

TlvDistance read_distance(wire::Bytes bytes, bool of_tag) {
    const std::size_t address_size = of_tag ? 2 : 8;
    TlvDistance distance{wire::little_bytes(bytes, 0, address_size),
                         wire::little<std::uint32_t>(bytes, address_size),
                         wire::little<std::uint8_t>(bytes, address_size + 4),
                         {}};
    if (of_tag) distance.position = read_position(bytes, address_size + 5);
    return distance;
}

void write_position(wire::Writer& out, const TlvPosition& position) {
    for (const std::int32_t mm : position.position_mm) out.little(mm);
    out.little(position.quality_percent);
}

void write_list(wire::Writer& out, const TlvReply& reply) {
    const bool of_tag = reply.from == TlvReply::From::tag;
    const std::size_t count = reply.distances.size();
    out.little(of_tag ? of_tag_type : of_anchor_type);
    out.little(static_cast<std::uint8_t>(1 + count * (of_tag ? placed_distance_size : distance_size)));
    out.little(static_cast<std::uint8_t>(count));
    for (const TlvDistance& distance : reply.distances) {
        out.little_bytes(distance.address, of_tag ? 2 : 8).little(distance.distance_mm);
        out.little(distance.quality_percent);
        if (of_tag) write_position(out, distance.position);
    }
}

/// Behind the position: a list, or the next reply.
Look look_at_list(wire::Bytes bytes) {
    const std::uint8_t type = bytes[list_at];
    if (type == status_type) return Look::frame(list_at);
    if (type != of_anchor_type && type != of_tag_type) return Look::none(Refusal::malformed);
    if (bytes.size() < list_at + 3) return Look::need(list_at + 3);
    const std::size_t length = bytes[list_at + 1], count = bytes[list_at + 2];
    const std::size_t size = type == of_tag_type ? placed_distance_size : distance_size;
    if (length != 1 + count * size || count > TlvReply::max_distances) return Look::none(Refusal::malformed);
    const std::size_t whole = list_at + 2 + length;
    if (bytes.size() < whole) return Look::need(whole);
    return parse_tlv_reply(bytes.first(whole)) ? Look::frame(whole) : Look::none(Refusal::malformed);
}

} // namespace

Look TlvFormat::look(wire::Bytes bytes) {
    if (bytes[0] != status_type) return Look::none(Refusal::garbage);
    if (bytes.size() < status_size) return Look::need(status_size);
    if (bytes[1] != 1 || bytes[2] > last_error) return Look::none(Refusal::garbage);
    if (bytes[2] != 0) return Look::frame(status_size);
    if (bytes.size() < status_size + 2) return Look::need(status_size + 2);
    if (bytes[3] != position_type || bytes[4] != position_size) return Look::none(Refusal::malformed);
    return bytes.size() > list_at ? look_at_list(bytes) : Look::need(list_at + 1);
}

std::optional<TlvReply> parse_tlv_reply(std::span<const std::uint8_t> bytes) {
    TlvReply reply;
    reply.error = wire::little<std::uint8_t>(bytes, 2);
    if (reply.error != 0) return reply;
    reply.position = read_position(bytes, status_size + 2);
    if (bytes.size() > list_at + 2) {
        const bool of_tag = bytes[list_at] == of_tag_type;
        const std::size_t size = of_tag ? placed_distance_size : distance_size;
        reply.from = of_tag ? TlvReply::From::tag : TlvReply::From::anchor;
        for (auto rest = bytes.subspan(list_at + 3);
             rest.size() >= size && reply.distances.size() < TlvReply::max_distances; rest = rest.subspan(size))
            reply.distances.push_back(read_distance(rest, of_tag));
    }
    return good(reply) ? std::optional{reply} : std::nullopt;
}

std::vector<std::uint8_t> encode(const TlvReply& reply) {
    wire::Writer out;
    out.little(status_type).little(std::uint8_t{1}).little(reply.error);
    if (reply.error == 0) {
        out.little(position_type).little(static_cast<std::uint8_t>(position_size));
        write_position(out, reply.position);
        if (reply.from != TlvReply::From::nobody) write_list(out, reply);
    }
    return out.take();
}

} // namespace locus::uwb::dwm1001
