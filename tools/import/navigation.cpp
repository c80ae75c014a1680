#include "tools/import/navigation.h"

#include "drivers/gnss/gps_timestamp.h"
#include "fusion/gnss/ephemeris_words.h"
#include "tools/import/lines.h"

#include <algorithm>
#include <ranges>
#include <set>

namespace locus::importing {
namespace {

constexpr Duration longest_ago = std::chrono::hours{12};

/// Constellation and number.
std::pair<unsigned, unsigned> satellite_of(const gnss::Ephemeris& ephemeris) {
    if (const auto* kepler = std::get_if<gnss::KeplerEphemeris>(&ephemeris))
        return {kepler->constellation, kepler->satellite};
    return {constellation::glonass, std::get<gnss::GlonassEphemeris>(ephemeris).satellite};
}

} // namespace

NavigationFile::NavigationFile(const std::string& path, Address tag) : tag_{tag} {
    Lines lines{path};
    gnss::rinex::Navigation navigation;
    std::string_view line;
    std::string error;
    const auto note = [&] {
        if (!error.empty()) report_.problem("line " + std::to_string(lines.number()) + ": " + error);
        error.clear();
    };
    while (lines.next(line)) {
        add(navigation.read(line, error));
        note();
    }
    add(navigation.finish(error));
    note();
    ionosphere_ = navigation.ionosphere();
    if (navigation.passed_over() > 0)
        report_.left_out["records of SBAS, NavIC or Galileo's F/NAV"] = navigation.passed_over();
    std::ranges::stable_sort(records_, {}, &Record::sent);
}

void NavigationFile::add(const std::optional<gnss::rinex::NavigationRecord>& printed) {
    if (printed) records_.push_back({gnss::timestamp(printed->sent), *printed});
}

GlonassSlots NavigationFile::glonass_slots() const {
    GlonassSlots slots;
    for (const Record& record : records_)
        if (const auto* e = std::get_if<gnss::GlonassEphemeris>(&record.printed.ephemeris))
            slots[e->satellite] = static_cast<std::uint8_t>(e->frequency + 7);
    return slots;
}

void NavigationFile::begin_at(Timestamp begin) {
    std::set<std::pair<unsigned, unsigned>> said;
    std::vector<Record> kept;
    for (Record record : std::views::reverse(records_)) {
        const bool early = record.sent <= begin;
        const bool use = !early || (begin - record.sent <= longest_ago &&
                                    said.insert(satellite_of(record.printed.ephemeris)).second);
        if (!use) continue;
        record.sent = std::max(record.sent, begin);
        kept.push_back(record);
    }
    if (kept.size() < records_.size())
        report_.left_out["records that newer ones replace before the first observation"] =
            records_.size() - kept.size();
    records_.assign(kept.rbegin(), kept.rend());
}

/// Every satellite of GPS tells it, so whichever is first.
void NavigationFile::read_ionosphere(std::vector<Item>& items) {
    if (!ionosphere_ || records_.empty()) return;
    const auto is_gps = [](const Record& r) { return satellite_of(r.printed.ephemeris).first == constellation::gps; };
    const auto first = std::ranges::find_if(records_, is_gps);
    const auto satellite = first == records_.end() ? 1U : satellite_of(first->printed.ephemeris).second;
    auto words = gnss::encode(*ionosphere_, static_cast<std::uint8_t>(satellite), records_.front().printed.sent);
    if (!words) ++report_.left_out["coefficients of the ionosphere that cannot be broadcast"];
    if (!words) return;
    words->tag = tag_;
    items.push_back({records_.front().sent, *words});
}

bool NavigationFile::read(std::vector<Item>& items) {
    read_ionosphere(items);
    for (const auto& [sent, printed] : records_) {
        auto words = gnss::encode(printed.ephemeris, printed.sent, printed.leap_s);
        if (words.empty()) ++report_.left_out["records with a value that cannot be broadcast"];
        for (GnssNavigation& one : words) {
            one.tag = tag_;
            items.push_back({sent, one});
        }
    }
    records_.clear();
    return false;
}

} // namespace locus::importing
