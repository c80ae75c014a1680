#include "fusion/radio/field_evidence.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>

namespace locus::radio {
namespace {

const LossPrior prior;
constexpr int sources_across = 9;
constexpr Eigen::Index most_point_sources = 128;

/// A beacon hangs near where it is strong, or somewhere about: a lattice over the map and a sixth beyond it on every
/// side, and the points themselves.
std::vector<Eigen::Vector2d> sources_over(const FloorPoints& points_m) {
    const Eigen::Vector2d low = points_m.colwise().minCoeff(), size = points_m.colwise().maxCoeff().transpose() - low;
    std::vector<Eigen::Vector2d> sources;
    for (int column = 0; column < sources_across; ++column)
        for (int row = 0; row < sources_across; ++row)
            sources.emplace_back(low + size.cwiseProduct(Eigen::Vector2d((column - 1) / 6.0, (row - 1) / 6.0)));
    const Eigen::Index step = 1 + points_m.rows() / most_point_sources;
    for (Eigen::Index i = 0; i < points_m.rows(); i += step) sources.emplace_back(points_m.row(i));
    return sources;
}

void add_bases(FieldData& data) {
    for (const Eigen::Vector2d& source : data.sources_m) data.bases.push_back(loss_basis(data.points_m, source));
}

double log_of_mean_of_exp(const Eigen::RowVectorXd& logs) {
    const double most = logs.maxCoeff();
    return most + std::log((logs.array() - most).exp().mean());
}

/// `most` of 0 .. all - 1, evenly.
std::vector<Eigen::Index> every_so_many(Eigen::Index all, Eigen::Index most) {
    std::vector<Eigen::Index> chosen;
    const Eigen::Index count = std::min(all, most);
    for (Eigen::Index i = 0; i < count; ++i) chosen.push_back(i * all / count);
    return chosen;
}

/// Who walks past a point in a second or two does not hear all that could be heard there: a beacon that is missing at a
/// point but was heard within hole_reach_m() counts as strong as there, each by its distance. Farther from all who
/// heard it, it is as weak as the hearing floor.
double strength_in_hole(const FloorPoints& points_m, const Eigen::VectorXd& heard_dbm, Eigen::Index hole,
                        double reach_m, double floor_dbm) {
    double sum = 0, weights = 0;
    for (Eigen::Index i = 0; i < heard_dbm.size(); ++i) {
        const double distance_m = (points_m.row(i) - points_m.row(hole)).norm();
        if (std::isnan(heard_dbm(i)) || distance_m > reach_m) continue;
        const double weight = 1 / (distance_m * distance_m + 1e-6);
        sum += weight * heard_dbm(i);
        weights += weight;
    }
    return weights > 0 ? sum / weights : floor_dbm;
}

Eigen::VectorXd strengths_of(const RadioMap& map, Address beacon, const FloorPoints& points_m) {
    Eigen::VectorXd heard_dbm(points_m.rows());
    for (Eigen::Index i = 0; i < heard_dbm.size(); ++i) {
        const Strength* strength = find(map.points[static_cast<std::size_t>(i)], beacon);
        heard_dbm(i) = strength != nullptr ? strength->mean_dbm : std::nan("");
    }
    Eigen::VectorXd all_dbm = heard_dbm;
    const double reach_m = hole_reach_m(map), floor_dbm = hearing_floor_dbm(map);
    for (Eigen::Index i = 0; i < all_dbm.size(); ++i)
        if (std::isnan(heard_dbm(i))) all_dbm(i) = strength_in_hole(points_m, heard_dbm, i, reach_m, floor_dbm);
    return all_dbm;
}

} // namespace

FieldData field_data(const RadioMap& map, const std::vector<Address>& beacons) {
    const auto count = static_cast<Eigen::Index>(map.points.size());
    FieldData data;
    data.points_m.resize(count, 2);
    data.strengths_dbm.resize(count, static_cast<Eigen::Index>(beacons.size()));
    for (Eigen::Index i = 0; i < count; ++i) {
        const Vec3& place = map.points[static_cast<std::size_t>(i)].position_site_m;
        data.points_m.row(i) << place[0], place[1];
    }
    for (std::size_t b = 0; b < beacons.size(); ++b)
        data.strengths_dbm.col(static_cast<Eigen::Index>(b)) = strengths_of(map, beacons[b], data.points_m);
    data.sources_m = sources_over(data.points_m);
    add_bases(data);
    return data;
}

FieldData thinned(const FieldData& data, Eigen::Index most_points, Eigen::Index most_beacons) {
    const std::vector<Eigen::Index> points = every_so_many(data.points_m.rows(), most_points);
    const std::vector<Eigen::Index> beacons = every_so_many(data.strengths_dbm.cols(), most_beacons);
    FieldData fewer;
    fewer.points_m = data.points_m(points, Eigen::all);
    fewer.strengths_dbm = data.strengths_dbm(points, beacons);
    fewer.sources_m = data.sources_m;
    add_bases(fewer);
    return fewer;
}

FieldEvidence::FieldEvidence(const FieldData& data, const FieldHypothesis& hypothesis) : data_(&data) {
    Eigen::MatrixXd covariance = shared_covariance(data.points_m, data.points_m, hypothesis);
    covariance.diagonal().array() += hypothesis.own_db * hypothesis.own_db;
    points_.compute(covariance);
    const double spread = 2 * Eigen::MatrixXd(points_.matrixL()).diagonal().array().log().sum();
    const Eigen::MatrixXd weighted = points_.solve(data.strengths_dbm);
    of_sources_.resize(data.strengths_dbm.cols(), static_cast<Eigen::Index>(data.sources_m.size()));
    for (std::size_t s = 0; s < data.sources_m.size(); ++s) {
        const LossBasis& basis = data.bases[s];
        Solved solved{points_.solve(basis), {}};
        Eigen::Matrix2d information = basis.transpose() * solved.weighted;
        information.diagonal() += prior.information;
        solved.covariance = information.inverse();
        const double log_information = std::log(information.determinant());
        const Eigen::VectorXd expected = basis * prior.mean, weighted_expected = solved.weighted * prior.mean;
        for (Eigen::Index b = 0; b < data.strengths_dbm.cols(); ++b) {
            const Eigen::VectorXd off = data.strengths_dbm.col(b) - expected;
            const Eigen::VectorXd weighted_off = weighted.col(b) - weighted_expected;
            const Eigen::Vector2d told = basis.transpose() * weighted_off;
            const double misfit = off.dot(weighted_off) - told.dot(solved.covariance * told);
            of_sources_(b, static_cast<Eigen::Index>(s)) = -0.5 * (misfit + spread + log_information);
        }
        solved_.push_back(std::move(solved));
    }
}

double FieldEvidence::total() const {
    double sum = 0;
    for (Eigen::Index b = 0; b < of_sources_.rows(); ++b) sum += log_of_mean_of_exp(of_sources_.row(b));
    return sum;
}

Eigen::Vector2d FieldEvidence::loss(Eigen::Index beacon, std::size_t source) const {
    const Solved& solved = solved_[source];
    const Eigen::VectorXd off = data_->strengths_dbm.col(beacon) - data_->bases[source] * prior.mean;
    return prior.mean + solved.covariance * (solved.weighted.transpose() * off);
}

} // namespace locus::radio
