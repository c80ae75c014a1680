// The points of a walk's path, and the sparse least squares that find them.
#pragma once

#include "fusion/uwb/survey/walk.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace locus::uwb::survey {

/// Points of the path: a stretch without gaps has them every step, and nothing joins two stretches.
struct Knots {
    std::vector<double> time_s;
    std::vector<bool> begins; ///< the first of its stretch

    Knots(const std::vector<WalkRange>& ranges, const WalkSettings& settings) {
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const bool begin = i == 0 || ranges[i].time_s - ranges[i - 1].time_s > settings.gap_s;
            if (begin) add(ranges[i].time_s, true);
            while (ranges[i].time_s > time_s.back()) add(time_s.back() + settings.step_s, false);
            if (begin) add(time_s.back() + settings.step_s, false);
        }
    }
    void add(double time, bool begin) {
        time_s.push_back(time);
        begins.push_back(begin);
    }
    std::size_t size() const { return time_s.size(); }
    /// The point before a time, with another of the same stretch behind it.
    std::size_t before(double time) const {
        const auto after = std::ranges::upper_bound(time_s, time) - time_s.begin();
        auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
        if (i + 1 == size() || begins[i + 1]) --i;
        return i;
    }
};

/// Sparse normal equations: points of the path first, then the biases.
class Equations {
  public:
    explicit Equations(std::size_t unknowns)
        : projection_{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns))} {}

    template <std::size_t N>
    void add(const std::array<std::size_t, N>& at, const std::array<double, N>& slope, double residual, double weight) {
        for (std::size_t i = 0; i < N; ++i) {
            projection_(static_cast<Eigen::Index>(at[i])) += weight * slope[i] * residual;
            for (std::size_t j = 0; j < N; ++j)
                if (at[j] <= at[i])
                    entries_.emplace_back(static_cast<int>(at[i]), static_cast<int>(at[j]),
                                          weight * slope[i] * slope[j]);
        }
    }
    void add_prior(std::size_t at, double pull) { projection_(static_cast<Eigen::Index>(at)) -= pull; }
    void add_information(std::size_t at, std::size_t before, double value) {
        entries_.emplace_back(static_cast<int>(at), static_cast<int>(before), value);
    }
    Eigen::SparseMatrix<double> information() const {
        Eigen::SparseMatrix<double> lower(projection_.size(), projection_.size());
        lower.setFromTriplets(entries_.begin(), entries_.end());
        return lower;
    }
    const Eigen::VectorXd& projection() const { return projection_; }

  private:
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::VectorXd projection_;
};

} // namespace locus::uwb::survey
