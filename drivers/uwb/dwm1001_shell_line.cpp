// Lines of the DWM1001 shell read and written: grammar in dwm1001_shell.h.
#include "drivers/uwb/dwm1001_shell.h"
#include "drivers/wire/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace locus::uwb::dwm1001 {
namespace {

using wire::Text;

bool read_triple(Text& text, Hundredths& triple) {
    return text.hundredths(triple[0]) && text.literal(",") && text.hundredths(triple[1]) && text.literal(",") &&
           text.hundredths(triple[2]);
}

/// "1.59,1.65,1.27,44"
bool read_position(Text& text, std::optional<Position>& position) {
    position.emplace();
    return read_triple(text, position->position_cm) && text.literal(",") && text.number(position->quality_percent) &&
           position->quality_percent <= 100;
}

/// ",AN0,2F2F,3.05,2.68,0.00,2.21"
bool read_lec_distance(Text& text, std::size_t index, Distance& distance) {
    std::size_t printed = 0;
    return text.literal(",AN") && text.number(printed) && printed == index && text.literal(",") &&
           text.hex(4, distance.anchor) && text.literal(",") && read_triple(text, distance.position_cm) &&
           text.literal(",") && text.hundredths(distance.distance_cm);
}

bool read_lec(Text& text, ShellLine& line) {
    std::size_t count = 0;
    if (!text.literal("DIST,") || !text.number(count) || count > ShellLine::max_distances) return false;
    for (std::size_t i = 0; i < count; ++i)
        if (!read_lec_distance(text, i, line.distances.emplace_back())) return false;
    return !text.literal(",POS,") || read_position(text, line.position);
}

/// "1151[5.00,8.00,2.25]=6.48 "
bool read_les_distance(Text& text, Distance& distance) {
    return text.hex(4, distance.anchor) && text.literal("[") && read_triple(text, distance.position_cm) &&
           text.literal("]=") && text.hundredths(distance.distance_cm) && text.literal(" ");
}

bool read_les(Text& text, ShellLine& line) {
    line.kind = ShellLine::Kind::les;
    while (!text.begins("le_us="))
        if (line.distances.size() == ShellLine::max_distances ||
            !read_les_distance(text, line.distances.emplace_back()))
            return false;
    if (!text.literal("le_us=") || !text.number(line.solver_us)) return false;
    return !text.literal(" est[") || (read_position(text, line.position) && text.literal("]"));
}

bool read_lep(Text& text, ShellLine& line) {
    line.kind = ShellLine::Kind::position;
    return text.literal("POS,") && read_position(text, line.position);
}

/// "x:2570 y:2000 z:1670 qf:97", in mm.
bool read_apg(Text& text, ShellLine& line) {
    line.kind = ShellLine::Kind::position;
    std::array<std::int32_t, 3> mm{};
    Position& position = line.position.emplace();
    const bool good = text.literal("x:") && text.number(mm[0]) && text.literal(" y:") && text.number(mm[1]) &&
                      text.literal(" z:") && text.number(mm[2]) && text.literal(" qf:") &&
                      text.number(position.quality_percent) && position.quality_percent <= 100;
    for (std::size_t i = 0; i < 3; ++i) position.position_cm[i] = mm[i] / 10;
    return good;
}

/// A lost piece between two lines can make one that names an anchor twice.
bool each_once(const ShellLine& line) {
    for (auto at = line.distances.begin(); at != line.distances.end(); ++at)
        if (std::any_of(std::next(at), line.distances.end(), [&](const Distance& d) { return d.anchor == at->anchor; }))
            return false;
    return true;
}

std::string metres(std::int64_t cm) {
    const std::int64_t size = std::abs(cm);
    return fmt::format("{}{}.{:02}", cm < 0 ? "-" : "", size / 100, size % 100);
}

std::string triple(const Hundredths& cm) { return metres(cm[0]) + "," + metres(cm[1]) + "," + metres(cm[2]); }

std::string written(const Position& position) {
    return fmt::format("{},{}", triple(position.position_cm), position.quality_percent);
}

std::string lec(const ShellLine& line) {
    std::string text = fmt::format("DIST,{}", line.distances.size());
    for (std::size_t i = 0; i < line.distances.size(); ++i) {
        const Distance& d = line.distances[i];
        text += fmt::format(",AN{},{:04X},{},{}", i, d.anchor, triple(d.position_cm), metres(d.distance_cm));
    }
    return line.position ? text + ",POS," + written(*line.position) : text;
}

std::string les(const ShellLine& line) {
    std::string text;
    for (const Distance& d : line.distances)
        text += fmt::format("{:04X}[{}]={} ", d.anchor, triple(d.position_cm), metres(d.distance_cm));
    text += fmt::format("le_us={}", line.solver_us);
    return line.position ? text + " est[" + written(*line.position) + "]" : text;
}

} // namespace

std::optional<ShellLine> parse_shell_line(std::string_view text) {
    ShellLine line;
    Text rest{text};
    const auto reader = rest.begins("DIST,")  ? read_lec
                        : rest.begins("POS,") ? read_lep
                        : rest.begins("x:")   ? read_apg
                                              : read_les;
    if (!reader(rest, line) || !rest.done() || !each_once(line)) return std::nullopt;
    return line;
}

std::string encode(const ShellLine& line) {
    switch (line.kind) {
    case ShellLine::Kind::lec:
        return lec(line) + "\r\n";
    case ShellLine::Kind::les:
        return les(line) + "\r\n";
    case ShellLine::Kind::position:
        break;
    }
    return "POS," + written(line.position.value_or(Position{})) + "\r\n";
}

} // namespace locus::uwb::dwm1001
