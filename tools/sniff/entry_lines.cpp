#include "tools/sniff/entry_lines.h"

#include "drivers/recording/hex.h"
#include "drivers/recording/measurement_json.h"
#include "tools/sniff/census.h"
#include "tools/sniff/words.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace locus::sniff {
namespace {

using nlohmann::ordered_json;
using RefusalCounts = std::array<std::size_t, refusal_count>;

RefusalCounts counted(const std::vector<Refusal>& refusals) {
    RefusalCounts counts{};
    for (const Refusal reason : refusals) ++counts[static_cast<std::size_t>(reason)];
    return counts;
}

/// "garbage 1, malformed 3".
template <class Numbers>
std::string reasons_text(const Numbers& counts) {
    std::string text;
    for (std::size_t i = 0; i < refusal_count; ++i)
        if (counts[i] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", refusal_names[i], counts[i]);
    return text;
}

template <class Numbers>
ordered_json reasons_json(const Numbers& counts) {
    ordered_json object = ordered_json::object();
    for (std::size_t i = 0; i < refusal_count; ++i)
        if (counts[i] > 0) object[std::string{refusal_names[i]}] = counts[i];
    return object;
}

bool of_can(const Entry& entry) { return entry.wire == Wire::can; }

std::string dump(const ordered_json& object) {
    return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

double per_second(std::uint64_t count, const Listing& listing) {
    const double seconds = to_s(listing.duration());
    return seconds > 0 ? static_cast<double>(count) / seconds : 0;
}

} // namespace

std::string entry_text(const Entry& entry, double time_s) {
    std::string text = fmt::format("{:12.6f}  ", time_s);
    if (of_can(entry)) text += id_text(entry.can_id) + "#";
    if (!entry.bytes.empty()) text += short_hex(entry.bytes);
    if (!entry.refusals.empty()) {
        text += fmt::format("{}refused: {}", entry.bytes.empty() ? "" : "  ", reasons_text(counted(entry.refusals)));
        return entry.skipped > 0 ? text + fmt::format("; {} bytes skipped", entry.skipped) : text;
    }
    for (const Measurement& m : entry.measurements) text += "  " + short_words(m.time, m.observation);
    return text;
}

std::string entry_json(const Entry& entry, double time_s) {
    ordered_json object{{"class", entry.refusals.empty() ? "FRAME" : "REFUSED"}, {"t", time_s}};
    if (of_can(entry)) object["id"] = id_text(entry.can_id);
    std::string hex;
    append_hex(hex, entry.bytes);
    if (!hex.empty()) object["hex"] = hex;
    if (!entry.refusals.empty()) {
        object["refused"] = reasons_json(counted(entry.refusals));
        object["skipped_bytes"] = entry.skipped;
        return dump(object);
    }
    object["measurements"] = ordered_json::array();
    for (const Measurement& m : entry.measurements)
        object["measurements"].push_back(ordered_json::parse(to_json_line(m)));
    return dump(object);
}

void EntryLines::print(const Entry& entry) {
    if (!first_) first_ = entry.time;
    const double time_s = to_s(entry.time - *first_);
    fmt::print("{}\n", json_ ? entry_json(entry, time_s) : entry_text(entry, time_s));
    std::fflush(stdout);
}

std::vector<std::string> summary_lines(const Listing& listing) {
    const Tally& tally = listing.tally();
    std::vector<std::string> lines{
        fmt::format("{:.1f} s, {} bytes ({:.0f} a second), {} frames ({:.1f} a second), {} measurements",
                    to_s(listing.duration()), listing.bytes(), per_second(listing.bytes(), listing), tally.frames,
                    per_second(tally.frames, listing), tally.all_measurements())};
    for (std::size_t i = 0; i < tally.measurements.size(); ++i)
        if (tally.measurements[i] > 0)
            lines.push_back(fmt::format("  {} {}", observation_names[i], tally.measurements[i]));
    if (tally.all_refused() > 0)
        lines.push_back(fmt::format("  refused: {}; {} bytes skipped", reasons_text(tally.refused), listing.skipped()));
    return lines;
}

std::string summary_json(const Listing& listing) {
    const Tally& tally = listing.tally();
    ordered_json object{{"class", "SUMMARY"},
                        {"seconds", to_s(listing.duration())},
                        {"bytes", listing.bytes()},
                        {"packets", listing.packets()},
                        {"frames", tally.frames},
                        {"refused", reasons_json(tally.refused)},
                        {"skipped_bytes", listing.skipped()}};
    object["measurements"] = ordered_json::object();
    for (std::size_t i = 0; i < tally.measurements.size(); ++i)
        if (tally.measurements[i] > 0)
            object["measurements"][std::string{observation_names[i]}] = tally.measurements[i];
    return dump(object);
}

void EntryLines::print_summary(const Listing& listing) const {
    if (json_) return fmt::print("{}\n", summary_json(listing));
    for (const std::string& line : summary_lines(listing)) fmt::print("{}\n", line);
}

} // namespace locus::sniff
