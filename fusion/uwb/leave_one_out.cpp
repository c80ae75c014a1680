#include "fusion/uwb/leave_one_out.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace locus::uwb {
namespace {

/// Of the error of an anchor in doubt, before it is heard: no error of a path or a survey is larger by much.
constexpr double doubt_sigma_m = 10;
constexpr double doubt_information = 1 / (doubt_sigma_m * doubt_sigma_m);
/// Stands for "known".
constexpr double certain = 1e12;

double information(double sigma_m) { return sigma_m > 0 ? 1 / (sigma_m * sigma_m) : certain; }

} // namespace

LeaveOneOut::LeaveOneOut(const Site& site, std::span<const SightLine> lines, const EpochPrior& prior,
                         std::span<const std::int16_t> in_doubt) noexcept
    : in_doubt_count_(std::min(in_doubt.size(), max_in_doubt)), row_count_(std::min(lines.size(), max_lines)) {
    std::copy_n(in_doubt.begin(), in_doubt_count_, in_doubt_.begin());
    for (std::size_t i = 0; i < row_count_; ++i) rows_[i] = row_of(lines[i], site);
    solve(prior);
}

LeaveOneOut::Row LeaveOneOut::row_of(const SightLine& line, const Site& site) const noexcept {
    const Sighting& s = line.sighting;
    Row row{s.plus, s.minus, 1 / (double{s.sigma_m} * double{s.sigma_m}), 0, Vector::Zero()};
    row.heard_m = s.value_m - predicted_m(s, site, line.tag_site_m);
    row.unknowns.head<3>() = gradient(s, site, line.tag_site_m);
    row.unknowns(3) = s.is_range() ? 1 : 0;
    for (std::size_t i = 0; i < in_doubt_count_; ++i) row.unknowns(4 + static_cast<int>(i)) = row.sign(in_doubt_[i]);
    return row;
}

void LeaveOneOut::solve(const EpochPrior& prior) noexcept {
    Matrix normal = Matrix::Zero();
    normal.diagonal() << information(prior.position_sigma_m.x()), information(prior.position_sigma_m.y()),
        information(prior.position_sigma_m.z()), information(prior.common_sigma_m),
        Eigen::Matrix<double, static_cast<int>(max_in_doubt), 1>::Constant(doubt_information);
    Vector projection = Vector::Zero();
    projection(3) = normal(3, 3) * prior.common_m;
    for (std::size_t i = 0; i < row_count_; ++i) {
        const Vector weighted = rows_[i].weight * rows_[i].unknowns;
        normal.noalias() += weighted * rows_[i].unknowns.transpose();
        projection += weighted * rows_[i].heard_m;
    }
    inverse_ = normal.llt().solve(Matrix::Identity());
    solution_.noalias() = inverse_ * projection;
}

/// With c the anchor's signs, W the weights, H the unknowns: information c'Wc - c'WH (H'WH)^-1 H'Wc, and the pull
/// alike with what was heard in the place of the second c. An anchor in doubt is among the unknowns already.
AnchorError LeaveOneOut::error_of(std::int16_t anchor) const noexcept {
    const auto end = in_doubt_.begin() + static_cast<std::ptrdiff_t>(in_doubt_count_);
    const auto found = std::find(in_doubt_.begin(), end, anchor);
    if (found != end) {
        const int at = 4 + static_cast<int>(found - in_doubt_.begin());
        const double posterior = 1 / inverse_(at, at);
        return {solution_(at) * posterior, std::max(0.0, posterior - doubt_information)};
    }
    AnchorError error;
    Vector shared = Vector::Zero();
    for (std::size_t i = 0; i < row_count_; ++i) {
        const Row& row = rows_[i];
        const double signed_weight = row.sign(anchor) * row.weight;
        if (signed_weight == 0) continue;
        shared += signed_weight * row.unknowns;
        error.pull += signed_weight * row.heard_m;
        error.information += row.weight;
    }
    error.pull -= shared.dot(solution_);
    error.information = std::max(0.0, error.information - shared.dot(inverse_ * shared));
    return error;
}

} // namespace locus::uwb
