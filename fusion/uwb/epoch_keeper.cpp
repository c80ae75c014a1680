#include "fusion/uwb/epoch_keeper.h"

#include "fusion/filter/gate.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

Vec3 array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

} // namespace

EpochKeeper::EpochKeeper(const Site& site, const EpochSettings& settings)
    : site_(&site), settings_(settings), quantile_in_sigma_(filter::gate_in_sigma(2 * settings.false_alarm)) {}

void EpochKeeper::keep(const Sighting& sighting, Timestamp time) noexcept {
    const auto end = kept_.begin() + static_cast<std::ptrdiff_t>(size_);
    const auto same = [&](const Kept& k) {
        return k.sighting.plus == sighting.plus && k.sighting.minus == sighting.minus;
    };
    auto place = std::find_if(kept_.begin(), end, same);
    if (place == end && size_ < kept_.size())
        ++size_;
    else if (place == end)
        place = std::min_element(kept_.begin(), end, [](const Kept& a, const Kept& b) { return a.time < b.time; });
    *place = {sighting, time};
}

EpochKeeper::Chosen EpochKeeper::choose(bool ranges, Timestamp now) const noexcept {
    Chosen chosen;
    for (std::size_t i = 0; i < size_; ++i)
        if (kept_[i].sighting.is_range() == ranges && to_s(now - kept_[i].time) <= settings_.window_s)
            chosen.kept[chosen.size++] = kept_[i];
    return chosen;
}

double EpochKeeper::sigma_m(const Kept& kept, Timestamp now) const noexcept {
    const double held_m = kept.sighting.is_range() ? settings_.held_range_sigma_m : settings_.held_difference_sigma_m;
    return std::hypot(double{kept.sighting.sigma_m}, held_m, settings_.speed_mps * to_s(now - kept.time));
}

double EpochKeeper::residual_in_sigma(const Kept& kept, const Eigen::Vector3d& position, Timestamp now) const noexcept {
    return std::abs(kept.sighting.value_m - predicted_m(kept.sighting, *site_, position)) / sigma_m(kept, now);
}

Fix EpochKeeper::solve_once(const Chosen& chosen, bool ranges, Timestamp now) const noexcept {
    std::array<RangeTo, max_observations> to;
    std::array<DifferenceOf, max_observations> of;
    for (std::size_t i = 0; i < chosen.size; ++i) {
        const Sighting& s = chosen.kept[i].sighting;
        const Vec3 plus_site_m = array(anchor_site_m(*site_, s.plus));
        if (ranges)
            to[i] = {plus_site_m, s.value_m, sigma_m(chosen.kept[i], now)};
        else
            of[i] = {array(anchor_site_m(*site_, s.minus)), plus_site_m, s.value_m, sigma_m(chosen.kept[i], now)};
    }
    return ranges ? solve_ranges({to.data(), chosen.size}, settings_.solve)
                  : solve_differences({of.data(), chosen.size}, settings_.solve);
}

/// Wilson and Hilferty's cube root turns the chi-square limit into a normal quantile.
bool EpochKeeper::agrees(const Fix& fix) const noexcept {
    if (fix.degrees_of_freedom <= 0) return true;
    const double spread = 2.0 / (9 * fix.degrees_of_freedom);
    return std::cbrt(fix.cost / fix.degrees_of_freedom) <= 1 - spread + quantile_in_sigma_ * std::sqrt(spread);
}

EpochKeeper::Answer EpochKeeper::solve_kind(bool ranges, Timestamp now,
                                            const Eigen::Vector3d& other_site_m) const noexcept {
    Chosen chosen = choose(ranges, now);
    Answer answer{solve_once(chosen, ranges, now)};
    for (std::size_t spare = chosen.size / 4; spare > 0; --spare) {
        if (answer.fix.reason != Exclusion::none || agrees(answer.fix)) break;
        const Eigen::Vector3d position = vector(answer.fix.position_site_m);
        const auto end = chosen.kept.begin() + static_cast<std::ptrdiff_t>(chosen.size);
        const auto worst = std::max_element(chosen.kept.begin(), end, [&](const Kept& a, const Kept& b) {
            return residual_in_sigma(a, position, now) < residual_in_sigma(b, position, now);
        });
        *worst = *(end - 1);
        --chosen.size;
        answer.fix = solve_once(chosen, ranges, now);
    }
    answer.agrees = answer.fix.reason == Exclusion::none && agrees(answer.fix);
    for (std::size_t i = 0; i < chosen.size; ++i) {
        const double residual = residual_in_sigma(chosen.kept[i], other_site_m, now);
        answer.cost_of_other += residual * residual;
    }
    return answer;
}

EpochKeeper::Answer EpochKeeper::solve(Timestamp now, const Eigen::Vector3d& other_site_m) const noexcept {
    const Answer ranges = solve_kind(true, now, other_site_m);
    if (ranges.fix.reason == Exclusion::none) return ranges;
    const Answer differences = solve_kind(false, now, other_site_m);
    return differences.fix.reason == Exclusion::geometry_too_few ? ranges : differences;
}

} // namespace locus::uwb
