#include "fusion/uwb/solve.h"

#include "fusion/geometry/dilution.h"
#include "fusion/geometry/spread.h"
#include "fusion/uwb/chan.h"
#include "fusion/uwb/taylor.h"

#include <Eigen/LU>

#include <cmath>

namespace locus::uwb {
namespace {

/// Thinner than this share of their length, anchors count as lying in one plane (3D) or line (2D).
constexpr double flat_share = 1e-3;
/// Thinner than this, a start in their middle may not find its way off the plane.
constexpr double thin_share = 0.1;
/// Two solutions whose costs differ by less than this are not told apart: odds below 20 to 1, 2 ln 20.
constexpr double undecided_cost = 6;
/// Solutions nearer than this many standard deviations are the same place for all purposes.
constexpr double same_place_sigma = 3;

template <int D>
class Search {
  public:
    Search(const Epoch& epoch, const Spread<D>& spread) : epoch_(epoch), spread_(spread) {}

    void start_from(const Eigen::Vector3d& start_m) {
        const Minimum<D> found = refine<D>(epoch_, start_m, any_ ? &best_ : nullptr);
        if (!found.converged) return;
        if (!any_)
            best_ = found;
        else if (!best_.is_at(found.position_m))
            take(found);
        any_ = true;
    }

    /// The reflection of the best solution, where it stands farther off the anchors' plane than they do themselves.
    void start_from_mirror() {
        const Eigen::Matrix<double, D, 1> from_centroid = best_.position_m.template head<D>() - spread_.centroid_m;
        const double height_m = spread_.normal.dot(from_centroid);
        if (!any_ || std::abs(height_m) <= spread_.thickness_m) return;
        Eigen::Vector3d mirror_m = best_.position_m;
        mirror_m.template head<D>() -= 2 * height_m * spread_.normal;
        start_from(mirror_m);
    }

    bool any() const { return any_; }
    bool disagree() const { return disagree_; }
    const Minimum<D>& best() const { return best_; }
    /// Lower cost, but not by enough to say that the other is wrong.
    bool undecided(double sigma_m) const {
        return disagree_ && other_.cost - best_.cost < undecided_cost &&
               (other_.position_m - best_.position_m).norm() > same_place_sigma * sigma_m;
    }

  private:
    void take(const Minimum<D>& found) {
        const bool lower = found.cost < best_.cost;
        const Minimum<D>& second = lower ? best_ : found;
        if (!disagree_ || second.cost < other_.cost) other_ = second;
        if (lower) best_ = found;
        disagree_ = true;
    }

    const Epoch& epoch_;
    const Spread<D>& spread_;
    Minimum<D> best_;
    Minimum<D> other_;
    bool any_ = false;
    bool disagree_ = false;
};

/// Whether no other place can be meant than the first minimum: it explains every observation as well as chance allows
/// (cost within two standard deviations of what noise alone gives), there are as many to spare as unknowns, which
/// a wrong place would have to fit by chance, and no reflection in the anchors' plane comes near to fitting.
template <int D>
bool is_beyond_doubt(const Epoch& epoch, const Spread<D>& spread, double cost) {
    const int spare = static_cast<int>(epoch.rows.size()) - D;
    return spare >= D && cost <= spare + 2 * std::sqrt(2.0 * spare) &&
           spread.thickness_m >= thin_share * spread.extent_m;
}

/// The anchors' centroid; off their plane where they are so flat that the centroid itself has no slope to follow.
template <int D>
Eigen::Vector3d middle(const Spread<D>& spread) {
    Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
    middle_m.head<D>() = spread.centroid_m;
    if (spread.thickness_m < thin_share * spread.extent_m) middle_m.head<D>() += spread.extent_m * spread.normal;
    return middle_m;
}

/// What is known to be wrong before any search.
template <int D>
Exclusion reason_against(const Spread<D>& spread) {
    if (D == 3 && spread.width_share < flat_share) return Exclusion::geometry_degenerate;
    return spread.thickness_m < flat_share * spread.extent_m ? Exclusion::geometry_mirror : Exclusion::none;
}

template <int D>
Fix fix_at(const Epoch& epoch, const Search<D>& search, double max_pdop) {
    const Minimum<D>& best = search.best();
    const Eigen::Matrix<double, D, D> covariance = best.information.inverse();
    Fix fix;
    fix.pdop = position_dilution<D>(covariance, epoch.mean_sigma_m());
    if (!(fix.pdop <= max_pdop)) return {Exclusion::geometry_degenerate};
    if (search.undecided(std::sqrt(covariance.trace()))) return {Exclusion::geometry_mirror};
    const Eigen::Vector3d position_m = best.position_m + epoch.origin_site_m;
    fix.reason = Exclusion::none;
    fix.position_site_m = {position_m.x(), position_m.y(), position_m.z()};
    Eigen::Map<Eigen::Matrix3d>(fix.covariance_m2.data()).topLeftCorner<D, D>() = covariance;
    fix.cost = best.cost;
    fix.degrees_of_freedom = static_cast<int>(epoch.rows.size()) - D;
    fix.starts_disagree = search.disagree();
    return fix;
}

template <int D>
Fix solve(const Epoch& epoch, const SolveSettings& settings, int fewest_anchors,
          ChanPoints (*closed_form)(const Epoch&) noexcept) {
    if (!epoch.finite) return {Exclusion::not_finite};
    if (epoch.anchor_count() < fewest_anchors) return {Exclusion::geometry_too_few};
    const Spread<D> spread = spread_of<D>(epoch.real_anchors_m().template topRows<D>());
    if (const Exclusion reason = reason_against<D>(spread); reason != Exclusion::none) return {reason};
    Search<D> search(epoch, spread);
    for (const Eigen::Vector3d& point : closed_form(epoch)) search.start_from(point);
    if (!search.any() || !is_beyond_doubt<D>(epoch, spread, search.best().cost)) search.start_from(middle<D>(spread));
    search.start_from_mirror();
    return search.any() ? fix_at<D>(epoch, search, settings.max_pdop) : Fix{Exclusion::geometry_degenerate};
}

} // namespace

Fix solve_ranges(std::span<const RangeTo> ranges, const SolveSettings& settings) noexcept {
    const Epoch epoch = epoch_of(ranges, settings);
    return settings.planar ? solve<2>(epoch, settings, 3, chan_ranges<2>)
                           : solve<3>(epoch, settings, 4, chan_ranges<3>);
}

Fix solve_differences(std::span<const DifferenceOf> differences, const SolveSettings& settings) noexcept {
    const Epoch epoch = epoch_of(differences, settings);
    return settings.planar ? solve<2>(epoch, settings, 3, chan_differences<2>)
                           : solve<3>(epoch, settings, 4, chan_differences<3>);
}

} // namespace locus::uwb
