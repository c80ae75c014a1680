#include "tools/calibrate/bias.h"

#include "config/address.h"
#include "fusion/geometry/vector.h"
#include "tools/evaluate/associate.h"
#include "tools/evaluate/read.h"
#include "tools/replay/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace locus::calibrate {
namespace {

using uwb::survey::KnownRange;
using uwb::survey::WalkRange;

constexpr double longest_range_m = 1e5;

/// Ranges by target, and what had to be left out.
struct Sorted {
    std::map<Address, std::vector<WalkRange>> by_tag;
    std::size_t strangers = 0, refused = 0, differences = 0;
};

bool usable(const Range& range) { return range.range_m > 0 && range.range_m < longest_range_m; }

void take(Sorted& sorted, const Measurement& m, const std::vector<Anchor>& anchors, double sigma_m) {
    if (std::holds_alternative<RangeDifference>(m.observation)) ++sorted.differences;
    const auto* range = std::get_if<Range>(&m.observation);
    if (!range) return;
    const auto anchor = std::ranges::find(anchors, range->anchor, &Anchor::address);
    if (anchor == anchors.end()) return void(++sorted.strangers);
    if (!usable(*range)) return void(++sorted.refused);
    const double own_m = std::isfinite(range->sigma_m) ? static_cast<double>(range->sigma_m) : anchor->sigma_m;
    sorted.by_tag[range->tag].push_back({to_s(m.time), static_cast<std::size_t>(anchor - anchors.begin()),
                                         range->range_m, std::isfinite(own_m) && own_m > 0 ? own_m : sigma_m});
}

std::string name_of(Address tag, const Settings& settings) {
    for (const auto& target : settings.engine.targets)
        if (target.address == tag) return target.name;
    return config::to_text(tag);
}

std::vector<WalkRange> of_target(Sorted& sorted, const BiasRequest& request, const Settings& settings) {
    if (sorted.by_tag.empty())
        throw std::runtime_error(sorted.differences
                                     ? "the recording holds range differences and no ranges: only ranges "
                                       "tell an anchor's own bias"
                                     : "the recording holds no range of an anchor of the site");
    std::string known;
    for (auto& [tag, ranges] : sorted.by_tag) {
        const std::string name = name_of(tag, settings);
        if (request.target == name || (request.target.empty() && sorted.by_tag.size() == 1)) return std::move(ranges);
        known += (known.empty() ? "" : ", ") + name;
    }
    throw std::runtime_error((request.target.empty()
                                  ? "the recording is of more than one target: say --target with one of "
                                  : "no range is of " + request.target + "; there are ranges of ") +
                             known);
}

std::vector<KnownRange> errors_against(const std::string& path, const Walk& walk) {
    evaluate::Track times; // the truth is interpolated at the time of each range
    for (const WalkRange& range : walk.ranges)
        if (times.empty() || range.time_s > times.back().time_s)
            times.push_back({range.time_s, Eigen::Vector3d::Zero()});
    std::map<double, Eigen::Vector3d> at_m;
    for (const auto& pair : associate(evaluate::read_truth(path), times, {}).pairs) at_m[pair.time_s] = pair.truth_m;
    std::vector<KnownRange> errors;
    for (const WalkRange& range : walk.ranges)
        if (const auto found = at_m.find(range.time_s); found != at_m.end()) {
            const double apart_m = (found->second - vector(walk.anchors[range.anchor].position_site_m)).norm();
            errors.push_back({range.anchor, range.range_m - apart_m});
        }
    if (errors.empty()) throw std::runtime_error("no range lies within the truth's time");
    return errors;
}

Eigen::Matrix<double, Eigen::Dynamic, 3> positions_of(const std::vector<Anchor>& anchors) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> at_m(static_cast<Eigen::Index>(anchors.size()), 3);
    for (std::size_t i = 0; i < anchors.size(); ++i)
        at_m.row(static_cast<Eigen::Index>(i)) = vector(anchors[i].position_site_m);
    return at_m;
}

} // namespace

Walk read_walk(const BiasRequest& request, const Settings& settings) {
    Walk walk{settings.engine.site.anchors, {}, {}};
    Sorted sorted;
    const auto report = replay::read_recording(request.file, settings, [&](const Measurement& m, Timestamp) {
        take(sorted, m, walk.anchors, request.sigma_m);
    });
    walk.ranges = of_target(sorted, request, settings);
    std::ranges::stable_sort(walk.ranges, {}, &WalkRange::time_s);
    if (sorted.strangers)
        walk.notes.push_back(
            fmt::format("{} ranges of anchors that the site does not have were left out", sorted.strangers));
    if (sorted.refused) walk.notes.push_back(fmt::format("{} ranges that are none were left out", sorted.refused));
    if (report.bad_lines) walk.notes.push_back(fmt::format("{} lines cannot be read", report.bad_lines));
    return walk;
}

BiasReport calibrate_bias(const BiasRequest& request, const Settings& settings) {
    BiasReport report{read_walk(request, settings), {}, !request.truth.empty()};
    report.biases = report.with_truth
                        ? biases_of_errors(report.walk.anchors.size(), errors_against(request.truth, report.walk),
                                           request.walk.common_prior_m)
                        : biases_of_walk(positions_of(report.walk.anchors), report.walk.ranges, request.walk);
    if (!report.biases.solved)
        throw std::runtime_error("these ranges give no position to start from: at least four anchors must be heard "
                                 "within half a second, and not stand in one plane with the tag");
    return report;
}

} // namespace locus::calibrate
