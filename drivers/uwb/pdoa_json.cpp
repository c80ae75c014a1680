// Lines of the PDoA kits: grammar in pdoa_json.h.
#include "drivers/uwb/pdoa_json.h"

#include "drivers/line_decoder.h"
#include "drivers/uwb/limits.h"
#include "drivers/wire/bytes.h"
#include "drivers/wire/json_scan.h"
#include "drivers/wire/text.h"

#include <fmt/format.h>

namespace locus::uwb {
namespace {

using wire::JsonMember;
using wire::JsonObject;
using wire::JsonValue;

/// The JSON behind "JS" and its length; empty when that is not what follows.
std::string_view counted_json(std::string_view line) {
    if (!line.starts_with("JS") || line.size() < 6) return {};
    std::string_view digits = line.substr(2, 4);
    digits.remove_prefix(std::min(digits.find_first_not_of(' '), digits.size()));
    digits = digits.substr(0, digits.find(' '));
    std::size_t length = 0;
    wire::Text text{digits};
    if (digits.empty() || !text.hex(digits.size(), length) || length != line.size() - 6) return {};
    return line.substr(6);
}

bool take_tag(const JsonValue& value, std::uint16_t& tag) {
    wire::Text text{value.text};
    return value.kind == JsonValue::Kind::string && text.hex(4, tag) && text.done();
}

/// Members of other names are newer than this, and no harm.
bool take_member(const JsonMember& member, PdoaReport& report) {
    const auto& [name, value] = member;
    if (name == "a16") return take_tag(value, report.tag);
    if (name == "R") return value.read(report.sequence);
    if (name == "T") return value.read(report.slot_time);
    if (name == "D") return value.read(report.distance_cm);
    if (name == "P") return value.read(report.phase_difference);
    if (name == "Xcm") return value.read(report.x_cm);
    if (name == "Ycm") return value.read(report.y_cm);
    if (name == "O") return value.read(report.clock_offset_hundredth_ppm);
    if (name == "V") return value.read(report.flags);
    if (name.size() == 1 && name[0] >= 'X' && name[0] <= 'Z')
        return value.read(report.acceleration_mg[static_cast<std::size_t>(name[0] - 'X')]);
    return true;
}

PdoaLine read_twr(std::string_view text, PdoaReport& report) {
    JsonObject object{text};
    bool tag = false, distance = false;
    for (JsonMember member; object.next(member);) {
        if (!take_member(member, report)) return PdoaLine::damaged;
        tag |= member.name == "a16";
        distance |= member.name == "D";
    }
    return object.whole() && tag && distance ? PdoaLine::report : PdoaLine::damaged;
}

class PdoaJson : public LineDecoder {
  public:
    explicit PdoaJson(const PdoaSettings& settings) : settings_(settings) {}

  protected:
    void line(std::string_view text, Timestamp begun, MeasurementSink& sink) override {
        PdoaReport report;
        const PdoaLine kind = parse_pdoa_line(text, report);
        if (kind == PdoaLine::damaged) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        if (kind == PdoaLine::report) range(report, begun, sink);
    }

  private:
    PdoaSettings settings_;

    void range(const PdoaReport& report, Timestamp time, MeasurementSink& sink) const {
        Range range;
        range.anchor = settings_.anchor;
        range.tag = address(report.tag);
        range.range_m = report.distance_cm * 1e-2;
        if (range.range_m < 0 || range.range_m > farthest_dw1000_m) return sink.refuse(Refusal::out_of_range);
        sink.accept(time, range);
    }
};

} // namespace

PdoaLine parse_pdoa_line(std::string_view line, PdoaReport& report) {
    JsonObject object{counted_json(line)};
    PdoaLine kind = PdoaLine::other;
    for (JsonMember member; object.next(member);)
        if (member.name == "TWR") kind = read_twr(member.value.text, report);
    return object.whole() ? kind : PdoaLine::damaged;
}

std::string encode(const PdoaReport& r) {
    const std::string json = fmt::format(
        R"({{"TWR": {{"a16":"{:04X}","R":{},"T":{},"D":{},"P":{},"Xcm":{},"Ycm":{},"O":{},"V":{},"X":{},"Y":{},"Z":{}}}}})",
        r.tag, r.sequence, r.slot_time, r.distance_cm, r.phase_difference, r.x_cm, r.y_cm, r.clock_offset_hundredth_ppm,
        r.flags, r.acceleration_mg[0], r.acceleration_mg[1], r.acceleration_mg[2]);
    return fmt::format("JS{:04X}{}\r\n", json.size(), json);
}

std::unique_ptr<Decoder> make_pdoa_json(const void* settings) {
    return std::make_unique<PdoaJson>(*static_cast<const PdoaSettings*>(settings));
}

} // namespace locus::uwb
