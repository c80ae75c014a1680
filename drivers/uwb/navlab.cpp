// NAV Lab lines: grammar in navlab.h.
#include "drivers/uwb/navlab.h"

#include "drivers/line_decoder.h"
#include "drivers/wire/bytes.h"
#include "drivers/wire/text.h"

#include <fmt/format.h>

namespace locus::uwb {
namespace {

constexpr double farthest_navlab_m = 20e3; // as the firmware of Decawave that it comes from

/// 4 or 16 digits.
bool read_navlab_address(wire::Text& text, std::uint64_t& address) {
    return (text.hex(4, address) || text.hex(16, address)) && text.literal(" ");
}

bool read_navlab_number(wire::Text& text, std::int32_t& number) {
    std::uint32_t bits = 0;
    if (!text.hex(8, bits)) return false;
    number = static_cast<std::int32_t>(bits);
    return true;
}

std::string navlab_address(std::uint64_t address) {
    return address < 0x10000 ? fmt::format("{:04x} ", address) : fmt::format("{:016x} ", address);
}

class Navlab : public LineDecoder {
  protected:
    void line(std::string_view text, Timestamp begun, MeasurementSink& sink) override {
        const auto said = parse_navlab_range(text);
        if (!said) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        Range range;
        range.anchor = address(said->anchor);
        range.tag = address(said->tag);
        range.range_m = said->range_mm * 1e-3;
        range.rx_power_dbm = static_cast<float>(said->rx_power_thousandth_dbm * 1e-3);
        if (range.range_m < 0 || range.range_m > farthest_navlab_m) return sink.refuse(Refusal::out_of_range);
        sink.accept(begun, range);
    }
};

} // namespace

std::optional<NavlabRange> parse_navlab_range(std::string_view line) {
    wire::Text text{line};
    NavlabRange range;
    const bool good = read_navlab_address(text, range.source) && read_navlab_address(text, range.anchor) &&
                      read_navlab_address(text, range.tag) && read_navlab_number(text, range.range_mm) &&
                      text.literal(" ") && read_navlab_number(text, range.range_by_power_mm) && text.literal(" ") &&
                      read_navlab_number(text, range.range_raw_mm) && text.literal(" ") &&
                      read_navlab_number(text, range.rx_power_thousandth_dbm) && text.done();
    return good ? std::optional{range} : std::nullopt;
}

std::string encode(const NavlabRange& range) {
    std::string line = navlab_address(range.source) + navlab_address(range.anchor) + navlab_address(range.tag);
    for (const std::int32_t number : {range.range_mm, range.range_by_power_mm, range.range_raw_mm})
        line += fmt::format("{:08x} ", static_cast<std::uint32_t>(number));
    return line + fmt::format("{:08x}\r\n", static_cast<std::uint32_t>(range.rx_power_thousandth_dbm));
}

std::unique_ptr<Decoder> make_navlab(const void* /*settings*/) { return std::make_unique<Navlab>(); }

} // namespace locus::uwb
