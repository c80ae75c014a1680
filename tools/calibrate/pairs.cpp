#include "tools/calibrate/pairs.h"

#include "config/address.h"
#include "tools/calibrate/fields.h"
#include "tools/evaluate/statistics.h"
#include "tools/import/lines.h"
#include "tools/replay/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>

namespace locus::calibrate {
namespace {

constexpr double longest_m = 1e5;
constexpr std::size_t most_anchors = 100;

using Ends = std::pair<Address, Address>; ///< the lower first

class Gathered {
  public:
    Gathered(const std::optional<Settings>& settings, double sigma_m) : settings_{settings}, sigma_m_{sigma_m} {}

    /// A sentence where the range cannot be used.
    std::optional<std::string> add(Address a, Address b, double range_m, double sigma_m) {
        if (a == b) return fmt::format("anchor {} cannot measure itself", config::to_text(a));
        if (!(range_m > 0) || range_m > longest_m) return fmt::format("{} m is no distance between anchors", range_m);
        if (sigma_m <= 0 || sigma_m > longest_m) return fmt::format("{} m is no standard deviation", sigma_m);
        auto& [ranges_m, sigmas_m] = series_[std::minmax(a, b)];
        ranges_m.push_back(range_m);
        if (std::isfinite(sigma_m)) sigmas_m.push_back(sigma_m);
        return {};
    }

    /// By name or address of the settings; without settings an address.
    std::optional<Address> anchor(std::string_view word) const {
        const auto number = config::parse_address(word);
        if (!settings_) return number;
        for (const Anchor& one : settings_->engine.site.anchors)
            if (one.name == word || one.address == number) return one.address;
        return {};
    }

    bool knows(Address address) const { return settings_ && settings_->engine.site.find_anchor(address); }

    MeasuredPairs result() const;

  private:
    struct Series {
        std::vector<double> ranges_m, sigmas_m;
    };

    const std::optional<Settings>& settings_;
    double sigma_m_;
    std::map<Ends, Series> series_;

    std::vector<Anchor> anchors() const;
};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return evaluate::quantile(values, 0.5);
}

std::vector<Anchor> Gathered::anchors() const {
    std::vector<Address> measured;
    for (const auto& [ends, series] : series_) measured.insert(measured.end(), {ends.first, ends.second});
    std::ranges::sort(measured);
    measured.erase(std::unique(measured.begin(), measured.end()), measured.end());
    std::vector<Anchor> anchors;
    if (settings_)
        for (const Anchor& anchor : settings_->engine.site.anchors)
            if (std::ranges::binary_search(measured, anchor.address)) anchors.push_back(anchor);
    if (!settings_)
        for (const Address address : measured) anchors.push_back({"A" + config::to_text(address), address});
    return anchors;
}

MeasuredPairs Gathered::result() const {
    MeasuredPairs found{anchors(), {}, {}, {}};
    if (found.anchors.empty()) throw std::runtime_error("no distance between two anchors was found");
    if (found.anchors.size() > most_anchors)
        throw std::runtime_error(fmt::format("{} anchors are more than the {} that can be surveyed at a time",
                                             found.anchors.size(), most_anchors));
    const auto index = [&](Address address) {
        const auto at = std::ranges::find(found.anchors, address, &Anchor::address);
        return static_cast<std::size_t>(at - found.anchors.begin());
    };
    for (const auto& [ends, series] : series_) {
        const double sigma_m = series.sigmas_m.empty() ? sigma_m_ : median(series.sigmas_m);
        found.pairs.push_back({index(ends.first), index(ends.second), median(series.ranges_m), sigma_m});
        found.counts.push_back(series.ranges_m.size());
    }
    if (settings_)
        for (const Anchor& anchor : settings_->engine.site.anchors)
            if (std::ranges::find(found.anchors, anchor.address, &Anchor::address) == found.anchors.end())
                found.notes.push_back(fmt::format("{} was measured by no other anchor: left as it is", anchor.name));
    return found;
}

std::optional<std::string> add_line(Gathered& gathered, const std::vector<std::string_view>& fields, bool named) {
    if (fields.size() != 3 && fields.size() != 4) return "it is not a,b,range_m or a,b,range_m,sigma_m";
    std::array<Address, 2> ends{};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto anchor = gathered.anchor(fields[i]);
        if (!anchor)
            return fmt::format("{} \"{}\"", named ? "the site has no anchor" : "without --config no address is",
                               std::string(fields[i].substr(0, 40)));
        ends[i] = *anchor;
    }
    const auto range_m = number_of(fields[2]);
    const auto sigma_m = fields.size() == 4 ? number_of(fields[3]) : std::optional{std::nan("")};
    if (!range_m || !sigma_m || (fields.size() == 4 && !std::isfinite(*sigma_m)))
        return "range_m and sigma_m must be numbers";
    return gathered.add(ends[0], ends[1], *range_m, *sigma_m);
}

/// Lines of people: all that is wrong is told, and nothing is used of a file in which anything is.
MeasuredPairs from_lines(const std::string& path, Gathered& gathered, bool named) {
    constexpr int most_told = 10;
    importing::Lines lines(path);
    std::string problems;
    int wrong_lines = 0;
    for (std::string_view line; lines.next(line);) {
        const auto fields = fields_of(line);
        if (fields[0].empty() || fields[0].front() == '#') continue;
        const bool titles = lines.number() == 1 && fields.size() > 2 && !number_of(fields[2]);
        if (titles) continue;
        const auto wrong = add_line(gathered, fields, named);
        if (wrong && ++wrong_lines <= most_told) problems += fmt::format("{}:{}: {}\n", path, lines.number(), *wrong);
    }
    if (wrong_lines) throw std::runtime_error(fmt::format("{}{} lines cannot be used", problems, wrong_lines));
    return gathered.result();
}

/// Ranges between anchors, and those that a recording tells as of an anchor and a tag when the tag is an anchor too.
MeasuredPairs from_recording(const std::string& path, const std::optional<Settings>& settings, Gathered& gathered) {
    std::size_t refused = 0, strangers = 0;
    bool own_number = false;
    const auto add = [&](Address a, Address b, double range_m, float sigma_m) {
        if (gathered.add(a, b, range_m, static_cast<double>(sigma_m))) ++refused;
    };
    const auto report =
        replay::read_recording(path, settings.value_or(Settings{}), [&](const Measurement& m, Timestamp) {
            if (const auto* pair = std::get_if<PeerRange>(&m.observation)) {
                const bool theirs = !settings || (gathered.knows(pair->tag_a) && gathered.knows(pair->tag_b));
                theirs ? add(pair->tag_a, pair->tag_b, pair->range_m, pair->sigma_m) : void(++strangers);
            }
            if (const auto* range = std::get_if<Range>(&m.observation)) {
                own_number |= range->anchor == range->tag;
                if (gathered.knows(range->anchor) && gathered.knows(range->tag) && range->anchor != range->tag)
                    add(range->anchor, range->tag, range->range_m, range->sigma_m);
            }
        });
    if (own_number)
        throw std::runtime_error("tags and anchors have the same numbers in this recording, so that ranges of a tag "
                                 "cannot be told from ranges between anchors; give distances as lines a,b,range_m");
    MeasuredPairs found = gathered.result();
    if (refused) found.notes.push_back(fmt::format("{} ranges that are none were left out", refused));
    if (strangers) found.notes.push_back(fmt::format("{} ranges of others than anchors were left out", strangers));
    if (report.bad_lines) found.notes.push_back(fmt::format("{} lines cannot be read", report.bad_lines));
    return found;
}

} // namespace

MeasuredPairs read_pairs(const std::string& path, const std::optional<Settings>& settings, double sigma_m) {
    Gathered gathered(settings, sigma_m);
    if (path.ends_with(".jsonl") || path.ends_with(".log")) return from_recording(path, settings, gathered);
    return from_lines(path, gathered, settings.has_value());
}

} // namespace locus::calibrate
