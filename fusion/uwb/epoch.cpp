#include "fusion/uwb/epoch.h"

#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

/// Room for all anchors that may come; no_anchor is there. Returns how many are.
int make_room(Epoch& epoch) {
    epoch.anchors_m.resize(3, Epoch::max_anchors);
    epoch.anchors_m.col(Epoch::no_anchor).setZero();
    return 1;
}

/// Index of the anchor at this place, added when it is new.
int anchor_index(Epoch& epoch, int& count, const Vec3& site_m) {
    const Eigen::Vector3d place = vector(site_m);
    for (int i = 1; i < count; ++i)
        if (epoch.anchors_m.col(i) == place) return i;
    epoch.anchors_m.col(count) = place;
    return count++;
}

void add_row(Epoch& epoch, int a, int b, double value_m, double sigma_m) {
    epoch.finite = epoch.finite && std::isfinite(value_m) && std::isfinite(sigma_m) && sigma_m > 0;
    epoch.rows.push_back({a, b, value_m, 1 / sigma_m});
}

/// Moves the origin to the centroid, and in the plane to the tag's height, so that z is zero there.
void centre(Epoch& epoch, int count, const SolveSettings& settings) {
    epoch.anchors_m.conservativeResize(3, count);
    epoch.finite = epoch.finite && epoch.real_anchors_m().allFinite() && std::isfinite(settings.height_site_m);
    if (epoch.rows.empty()) return;
    epoch.origin_site_m = epoch.real_anchors_m().rowwise().mean();
    if (settings.planar) epoch.origin_site_m.z() = settings.height_site_m;
    epoch.anchors_m.rightCols(count - 1).colwise() -= epoch.origin_site_m;
}

} // namespace

double Epoch::mean_sigma_m() const {
    double weight = 0;
    for (const Row& row : rows) weight += row.inverse_sigma * row.inverse_sigma;
    return std::sqrt(static_cast<double>(rows.size()) / weight);
}

Epoch epoch_of(std::span<const RangeTo> ranges, const SolveSettings& settings) noexcept {
    Epoch epoch;
    int count = make_room(epoch);
    for (const RangeTo& range : ranges.first(std::min(ranges.size(), max_observations)))
        add_row(epoch, Epoch::no_anchor, anchor_index(epoch, count, range.anchor_site_m), range.range_m, range.sigma_m);
    centre(epoch, count, settings);
    return epoch;
}

Epoch epoch_of(std::span<const DifferenceOf> differences, const SolveSettings& settings) noexcept {
    Epoch epoch;
    epoch.correlation = settings.difference_correlation;
    int count = make_room(epoch);
    for (const DifferenceOf& d : differences.first(std::min(differences.size(), max_observations))) {
        const int a = anchor_index(epoch, count, d.anchor_a_site_m);
        add_row(epoch, a, anchor_index(epoch, count, d.anchor_b_site_m), d.difference_m, d.sigma_m);
    }
    centre(epoch, count, settings);
    return epoch;
}

} // namespace locus::uwb
