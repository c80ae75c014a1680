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

/// Where it was kept, or the end of what is kept.
const EpochKeeper::Kept* EpochKeeper::find(const Sighting& sighting) const noexcept {
    return std::find_if(kept_.data(), kept_.data() + size_, [&](const Kept& k) {
        return k.sighting.plus == sighting.plus && k.sighting.minus == sighting.minus;
    });
}

void EpochKeeper::keep(const Sighting& sighting, Timestamp time) noexcept {
    auto place = static_cast<std::size_t>(find(sighting) - kept_.data());
    if (place == size_ && size_ < kept_.size())
        ++size_;
    else if (place == size_)
        place = static_cast<std::size_t>(
            std::min_element(kept_.begin(), kept_.end(), [](const Kept& a, const Kept& b) { return a.time < b.time; }) -
            kept_.begin());
    kept_[place] = {sighting, time};
}

bool EpochKeeper::heard(const Sighting& sighting, Timestamp since) const noexcept {
    const Kept* found = find(sighting);
    return found != kept_.data() + size_ && found->time >= since;
}

EpochKeeper::Chosen EpochKeeper::choose(bool ranges, Timestamp since) const noexcept {
    Chosen chosen;
    for (std::size_t i = 0; i < size_; ++i)
        if (kept_[i].sighting.is_range() == ranges && kept_[i].time >= since) chosen.kept[chosen.size++] = kept_[i];
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

EpochKeeper::Answer EpochKeeper::solve_kind(bool ranges, Timestamp since, Timestamp now,
                                            const Eigen::Vector3d& other_site_m) const noexcept {
    Chosen chosen = choose(ranges, since);
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
    return solve_since(now - duration_from_s(settings_.window_s), now, other_site_m);
}

EpochKeeper::Answer EpochKeeper::solve_since(Timestamp since, Timestamp now,
                                             const Eigen::Vector3d& other_site_m) const noexcept {
    const Answer ranges = solve_kind(true, since, now, other_site_m);
    if (ranges.fix.reason == Exclusion::none) return ranges;
    const Answer differences = solve_kind(false, since, now, other_site_m);
    return differences.fix.reason == Exclusion::geometry_too_few ? ranges : differences;
}

} // namespace locus::uwb
