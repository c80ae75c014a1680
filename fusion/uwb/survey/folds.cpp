#include "fusion/uwb/survey/folds.h"

#include <Eigen/Dense>

namespace locus::uwb::survey {
namespace {

Positions neighbours_of(const std::vector<PairRange>& pairs, const Positions& at_m, std::size_t station) {
    std::vector<Eigen::Index> others;
    for (const PairRange& pair : pairs) {
        if (pair.a == station) others.push_back(static_cast<Eigen::Index>(pair.b));
        if (pair.b == station) others.push_back(static_cast<Eigen::Index>(pair.a));
    }
    return at_m(others, Eigen::all);
}

/// Mirror image of a point in the plane (or line) that lies best between the others.
Eigen::Vector3d reflection(const Eigen::Vector3d& point_m, const Positions& others_m, int dimensions) {
    const Eigen::RowVector3d centre_m = others_m.colwise().mean();
    const Eigen::MatrixXd arms_m = (others_m.rowwise() - centre_m).leftCols(dimensions);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(arms_m, Eigen::ComputeFullV);
    const Eigen::VectorXd normal = svd.matrixV().col(dimensions - 1);
    const Eigen::VectorXd arm_m = (point_m - centre_m.transpose()).head(dimensions);
    Eigen::Vector3d image_m = point_m;
    image_m.head(dimensions) -= 2 * normal.dot(arm_m) * normal;
    return image_m;
}

std::vector<PairRange> pairs_of(const std::vector<PairRange>& pairs, std::size_t station) {
    std::vector<PairRange> own;
    for (const PairRange& pair : pairs)
        if (pair.a == station || pair.b == station) own.push_back(pair);
    return own;
}

/// One anchor among others that stay: what it needs to be moved by itself.
struct Alone {
    std::vector<PairRange> pairs;
    Sought sought;
    Positions image_m; ///< everything as it is, but the anchor folded over

    Alone(const std::vector<PairRange>& all, const Sought& among, const Positions& at_m, std::size_t station,
          int dimensions)
        : pairs{pairs_of(all, station)}, sought{Sought::Constant(among.rows(), 3, false)}, image_m{at_m} {
        const auto row = static_cast<Eigen::Index>(station);
        if (pairs.empty() || !among.row(row).head(dimensions).all()) return;
        sought.row(row) = among.row(row);
        const Eigen::Vector3d here_m = at_m.row(row).transpose();
        image_m.row(row) = reflection(here_m, neighbours_of(pairs, at_m, station), dimensions).transpose();
    }
    bool movable() const { return sought.any(); }
};

/// The best places of one anchor that its pairs less one lead to: only where few measured it, for then one counts.
Descent without_one(const Alone& alone, Descent best) {
    constexpr std::size_t few = 12;
    if (alone.pairs.size() > few) return best;
    for (std::size_t left_out = 0; left_out < alone.pairs.size(); ++left_out) {
        auto rest = alone.pairs;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
        for (const Positions& start_m : {best.position_m, alone.image_m}) {
            const Descent there = descend(alone.pairs, alone.sought, descend(rest, alone.sought, start_m).position_m);
            if (there.cost < best.cost) best = there;
        }
    }
    return best;
}

/// Better place of one anchor than where it is, if there is one; the others stay.
Positions replaced(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& at_m,
                   std::size_t station, int dimensions) {
    const Alone alone(pairs, sought, at_m, station, dimensions);
    if (!alone.movable()) return at_m;
    const Descent best = descend(alone.pairs, alone.sought, at_m);
    const Descent over = descend(alone.pairs, alone.sought, alone.image_m);
    return without_one(alone, over.cost < best.cost ? over : best).position_m;
}

} // namespace

Descent folded(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& at_m, std::size_t station,
               int dimensions) {
    const Alone alone(pairs, sought, at_m, station, dimensions);
    if (!alone.movable()) return descend(pairs, sought, at_m);
    return descend(pairs, sought, descend(alone.pairs, alone.sought, alone.image_m).position_m);
}

namespace {

/// Every pair may be the one that holds all in a wrong shape: the best of what is reached without each of them.
Descent without_a_pair(const std::vector<PairRange>& pairs, const Sought& sought, Descent best) {
    constexpr std::size_t few = 200; // with more of them one pair holds nothing
    constexpr double all_fits = 1.5; // of the cost a pair: 0.9 of normal errors
    if (pairs.size() > few || best.cost < all_fits * static_cast<double>(pairs.size())) return best;
    for (std::size_t left_out = 0; left_out < pairs.size(); ++left_out) {
        auto rest = pairs;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
        const Descent there = descend(pairs, sought, descend_snooping(rest, sought, best.position_m).position_m);
        if (there.cost < best.cost) best = there;
    }
    return best;
}

} // namespace

Descent unfolded(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m, int dimensions) {
    Descent best = without_a_pair(pairs, sought, descend_snooping(pairs, sought, start_m));
    constexpr double clearly = 1e-3; // of the cost: not the same minimum with other last digits
    const auto stations = static_cast<std::size_t>(start_m.rows());
    std::size_t since_better = 0;
    for (std::size_t turn = 0; since_better < stations && turn < 4 * stations; ++turn, ++since_better) {
        const Positions moved_m = replaced(pairs, sought, best.position_m, turn % stations, dimensions);
        const Descent other = descend(pairs, sought, moved_m);
        if (other.cost >= best.cost - clearly) continue;
        best = other;
        since_better = 0;
    }
    return best;
}

} // namespace locus::uwb::survey
