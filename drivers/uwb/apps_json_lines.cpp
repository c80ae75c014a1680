// Lines of uwb-apps, read and written: grammar in apps_json.h.
#include "drivers/uwb/apps_json.h"
#include "drivers/wire/json_scan.h"
#include "drivers/wire/text.h"

#include <fmt/format.h>

namespace locus::uwb::apps {
namespace {

using wire::JsonList;
using wire::JsonMember;
using wire::JsonObject;
using wire::JsonValue;

/// "d22d" or "0x499b".
bool take_address(const JsonValue& value, std::uint64_t& address) {
    wire::Text text{value.text};
    text.literal("0x");
    const std::size_t digits = text.hex_digits();
    return value.kind == JsonValue::Kind::string && digits > 0 && digits <= 16 && text.hex(digits, address) &&
           text.done();
}

/// Both lists have one item for each peer that answered.
bool take_lists(const JsonValue& ranges, const JsonValue& addresses, Ranges& report) {
    if (ranges.kind != JsonValue::Kind::list || addresses.kind != JsonValue::Kind::list) return false;
    JsonList range_list{ranges}, address_list{addresses};
    JsonValue range, address;
    for (;;) {
        const bool more = range_list.next(range);
        if (more != address_list.next(address)) return false;
        if (!more) return true;
        Ranges::Item item;
        if (report.items.size() == most_peers || !range.read(item.range_m) || !take_address(address, item.peer))
            return false;
        report.items.push_back(item);
    }
}

bool take_many(std::string_view text, Ranges& report) {
    JsonObject object{text};
    JsonValue ranges, addresses;
    for (JsonMember member; object.next(member);) {
        if (member.name == "rng") ranges = member.value;
        if (member.name == "uid") addresses = member.value;
    }
    return object.whole() && take_lists(ranges, addresses, report);
}

/// With angles "rng" is "raz": range, azimuth, zenith.
bool take_one(std::string_view text, Ranges& report) {
    JsonObject object{text};
    Ranges::Item item;
    bool range = false, peer = false;
    for (JsonMember member; object.next(member);) {
        if (member.name == "rng" || member.name == "raz") range = member.value.first().read(item.range_m);
        if (member.name == "uid") peer = take_address(member.value, item.peer);
    }
    if (!peer) item.peer = number(no_address); // whose it is stands outside
    report.items.assign(1, item);
    return object.whole() && range;
}

void take_diagnostics(std::string_view text, Ranges& report) {
    JsonObject object{text};
    for (JsonMember member; object.next(member);) {
        double value = 0;
        if (!member.value.read(value)) continue;
        if (member.name == "rssi" && value < 0 && value > -200) report.rx_power_dbm = static_cast<float>(value);
        if (member.name == "los" && value >= 1) report.line_of_sight = LineOfSight::clear;
        if (member.name == "los" && value <= 0) report.line_of_sight = LineOfSight::blocked;
    }
}

bool take_difference(const JsonValue& value, Differences& report) {
    JsonObject object{value.text};
    Differences::Item item;
    bool anchor = false, difference = false;
    for (JsonMember member; object.next(member);) {
        if (member.name == "addr") anchor = take_address(member.value, item.anchor);
        if (member.name == "ddist") difference = member.value.read(item.difference_m);
    }
    if (!object.whole() || !anchor || !difference || report.items.size() == most_peers) return false;
    if (item.anchor != report.reference) report.items.push_back(item); // the reference's own is noise
    return true;
}

bool take_differences(const JsonValue& list, Differences& report) {
    if (list.kind != JsonValue::Kind::list) return false;
    JsonList items{list};
    for (JsonValue item; items.next(item);)
        if (!take_difference(item, report)) return false;
    return true;
}

/// The members that matter, wherever in the line they stand.
struct Line {
    JsonValue one, many, diagnostics, node, listener, reference, measured, pressure;

    bool read(std::string_view text) {
        JsonObject object{text};
        for (JsonMember member; object.next(member);)
            if (JsonValue* value = place_of(member.name)) *value = member.value;
        return object.whole();
    }

  private:
    JsonValue* place_of(std::string_view name) {
        if (name == "twr") return &one;
        if (name == "nrng") return &many;
        if (name == "diag") return &diagnostics;
        if (name == "uid") return &node;
        if (name == "id") return &listener;
        if (name == "ref_anchor") return &reference;
        if (name == "meas") return &measured;
        return name == "pres" ? &pressure : nullptr;
    }
};

bool is_there(const JsonValue& value) { return value.kind != JsonValue::Kind::nothing; }

std::optional<Report> ranges_of(const Line& line) {
    Ranges report;
    const bool good = is_there(line.many) ? take_many(line.many.text, report) : take_one(line.one.text, report);
    std::uint64_t node = 0;
    if (!good || (is_there(line.node) && !take_address(line.node, node))) return std::nullopt;
    if (is_there(line.node)) report.node = node;
    if (is_there(line.diagnostics)) take_diagnostics(line.diagnostics.text, report);
    return report;
}

std::optional<Report> differences_of(const Line& line) {
    Differences report;
    double pressure_pa = 0;
    if (!take_address(line.listener, report.node) || !take_address(line.reference, report.reference) ||
        !take_differences(line.measured, report))
        return std::nullopt;
    if (line.pressure.read(pressure_pa)) report.pressure_pa = pressure_pa;
    return report;
}

} // namespace

std::optional<Report> parse(std::string_view text) {
    Line line;
    if (!line.read(text)) return std::nullopt;
    if (is_there(line.one) || is_there(line.many)) return ranges_of(line);
    if (is_there(line.measured)) return differences_of(line);
    return Report{};
}

std::string encode(const Ranges& ranges) {
    if (ranges.items.size() == 1 && ranges.node) {
        const auto& [peer, range_m] = ranges.items[0];
        return fmt::format(R"({{"utime":1,"twr":{{"rng":"{:.3f}","uid":"{:x}"}},"uid":"{:x}"}})"
                           "\r\n",
                           range_m, peer, *ranges.node);
    }
    std::string lengths, addresses;
    for (const auto& [peer, range_m] : ranges.items) {
        lengths += fmt::format(R"({}"{:.3f}")", lengths.empty() ? "" : ",", range_m);
        addresses += fmt::format(R"({}"{:x}")", addresses.empty() ? "" : ",", peer);
    }
    return fmt::format(R"({{"utime":1,"nrng":{{"seq":1,"mask":{},"rng":[{}],"uid":[{}]}}}})"
                       "\r\n",
                       (std::uint64_t{1} << ranges.items.size()) - 1, lengths, addresses);
}

std::string encode(const Differences& differences) {
    std::string items;
    for (const auto& [anchor, difference_m] : differences.items)
        items += fmt::format(R"({}{{"addr":"{:x}","ddist":"{:.3f}","tqf":1}})", items.empty() ? "" : ",", anchor,
                             difference_m);
    const std::string pressure =
        differences.pressure_pa ? fmt::format(R"("pres":{:.0f},)", *differences.pressure_pa) : "";
    return fmt::format(R"({{"id":"0x{:x}",{}"ref_anchor":"{:x}","meas":[{}]}})"
                       "\r\n",
                       differences.node, pressure, differences.reference, items);
}

} // namespace locus::uwb::apps
