// Where NLink frames begin and end. Marks 0 and 1 have a fixed length, the others tell theirs; mark 0 has no checksum
// but a constant last byte, so its roles must be known ones too.
#include "drivers/uwb/nlink_messages.h"
#include "drivers/wire/checksum.h"

namespace locus::uwb::nlink {
namespace {

/// Of a frame that tells its length: bytes up to the count of its elements, that too, and the bytes of an element.
struct Shape {
    std::size_t head;
    std::size_t element; ///< 0: elements differ in length
};

/// By mark, from node_frame0 on (protocols.md 2.2).
constexpr std::array<Shape, 8> shapes{{{11, 0}, {27, 20}, {119, 13}, {21, 7}, {21, 0}, {21, 11}, {24, 10}, {14, 0}}};

Look summed(wire::Bytes bytes, std::size_t length) {
    if (bytes.size() < length) return Look::need(length);
    const bool good = wire::sum8(bytes.first(length - 1)) == bytes[length - 1];
    return good ? Look::frame(length) : Look::none(Refusal::bad_checksum);
}

Look anchor_frame(wire::Bytes bytes) {
    constexpr std::size_t length = 896;
    if (bytes.size() < length) return Look::need(length);
    if (bytes[length - 1] != anchor_frame_end) return Look::none(Refusal::bad_checksum);
    return parse(bytes.first(length)) ? Look::frame(length) : Look::none(Refusal::malformed);
}

/// A false head is found out by its count, before it has waited for all the bytes that it claims.
Look node_frame(wire::Bytes bytes, Shape shape) {
    if (bytes.size() < shape.head) return Look::need(shape.head);
    const auto length = wire::little<std::uint16_t>(bytes, 2);
    const std::size_t count = bytes[shape.head - 1];
    const bool fits = shape.element != 0 ? length == shape.head + count * shape.element + 1 : length > shape.head;
    if (!fits) return Look::none(Refusal::malformed);
    if (length > max_frame) return Look::none(Refusal::too_long);
    const Look look = summed(bytes, length);
    if (look.kind == Look::Kind::frame && !parse(bytes.first(length))) return Look::none(Refusal::malformed);
    return look;
}

} // namespace

Look Format::look(wire::Bytes bytes) {
    if (bytes[0] != link_track_sync && bytes[0] != tof_sense_sync) return Look::none(Refusal::garbage);
    if (bytes.size() < 2) return Look::need(2);
    const std::uint8_t mark = bytes[1];
    if (bytes[0] == tof_sense_sync) return mark == 0 ? summed(bytes, 16) : Look::none(Refusal::garbage);
    if (mark == 0) return anchor_frame(bytes);
    if (mark == 1) return summed(bytes, 128);
    if (mark - 2u >= shapes.size()) return Look::none(Refusal::unknown_type);
    return node_frame(bytes, shapes[mark - 2u]);
}

} // namespace locus::uwb::nlink
