// Frame control, lowest bit first: type (3), security, pending, acknowledge, PAN compression, reserved (3), destination
// mode (2), version (2), source mode (2). A mode is 0: none, 2: short, 3: long.
#include "drivers/radio/mac_header.h"

namespace locus::radio {
namespace {

constexpr unsigned none_mode = 0, short_mode = 2, long_mode = 3;
constexpr unsigned compression_bit = 6, destination_at = 10, version_at = 12, source_at = 14;

class Fields {
  public:
    explicit Fields(wire::Bytes bytes) : rest_{bytes} {}

    std::uint64_t take(std::size_t count) {
        if (count > rest_.size()) return short_ = true, 0;
        const std::uint64_t value = wire::little_bytes(rest_, 0, count);
        rest_ = rest_.subspan(count);
        return value;
    }

    std::optional<MacHeader::Node> node(unsigned mode, std::optional<std::uint16_t> known_pan) {
        if (mode == none_mode) return std::nullopt;
        MacHeader::Node node;
        node.pan = known_pan ? *known_pan : static_cast<std::uint16_t>(take(2));
        node.is_long = mode == long_mode;
        node.address = take(node.is_long ? 8 : 2);
        return node;
    }

    bool was_short() const { return short_; }

  private:
    wire::Bytes rest_;
    bool short_ = false;
};

unsigned mode_of(const std::optional<MacHeader::Node>& node) {
    if (!node) return none_mode;
    return node->is_long ? long_mode : short_mode;
}

void write(wire::Writer& out, const MacHeader::Node& node, bool with_pan) {
    if (with_pan) out.little(node.pan);
    out.little_bytes(node.address, node.is_long ? 8 : 2);
}

bool shares_pan(const MacHeader& header) {
    return header.destination && header.source && header.destination->pan == header.source->pan;
}

} // namespace

std::optional<MacHeader> parse_mac_header(wire::Bytes frame) {
    Fields fields{frame};
    const auto control = static_cast<unsigned>(fields.take(2));
    const unsigned to = control >> destination_at & 3, from = control >> source_at & 3;
    const bool compressed = (control >> compression_bit & 1) != 0;
    if ((control >> version_at & 3) > 1 || to == 1 || from == 1) return std::nullopt;
    MacHeader header{static_cast<std::uint8_t>(control & 7), static_cast<std::uint8_t>(fields.take(1)), {}, {}};
    header.destination = fields.node(to, std::nullopt);
    const bool same_pan = compressed && header.destination;
    header.source = fields.node(from, same_pan ? std::optional{header.destination->pan} : std::nullopt);
    if (fields.was_short()) return std::nullopt;
    return header;
}

std::vector<std::uint8_t> encode(const MacHeader& header) {
    const bool compressed = shares_pan(header);
    const unsigned control = header.type | static_cast<unsigned>(compressed) << compression_bit |
                             mode_of(header.destination) << destination_at | mode_of(header.source) << source_at;
    wire::Writer out;
    out.little(static_cast<std::uint16_t>(control)).little(header.sequence);
    if (header.destination) write(out, *header.destination, true);
    if (header.source) write(out, *header.source, !compressed);
    return out.take();
}

} // namespace locus::radio
