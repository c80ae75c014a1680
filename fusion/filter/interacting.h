// Two models of how a target moves, and how likely each is of being true now: the interacting multiple model of Blom
// and Bar-Shalom (1988), for two. Each filter goes on from a mixture of both, more of the other's the less it was
// right itself, so that the one that was wrong for long begins where the right one is when its time comes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace locus::filter {

class ModelPair {
  public:
    /// `dwell_s`: how long a target keeps to one way of moving, on average.
    explicit ModelPair(double dwell_s) noexcept : dwell_s_(dwell_s) {}

    /// Of the second model; the first has the rest.
    double share() const noexcept { return share_; }

    /// What each filter takes over of the other one.
    struct Mixing {
        double second_in_first = 0;
        double first_in_second = 0;
    };
    /// `dt_s` goes by, in which the target may have changed its way.
    Mixing pass(double dt_s) noexcept {
        const double changed = -std::expm1(-2 * dt_s / dwell_s_) / 2;
        const double second = share_ * (1 - changed) + (1 - share_) * changed;
        const Mixing mixing{share_ * changed / (1 - second), (1 - share_) * changed / second};
        share_ = second;
        return mixing;
    }

    /// Both have predicted the same number: innovations and their standard deviations.
    void learn(std::array<double, 2> innovation, std::array<double, 2> sigma) noexcept {
        const auto square = [](double x) { return x * x; };
        const double worth = 0.5 * (square(innovation[0] / sigma[0]) - square(innovation[1] / sigma[1]));
        const double odds = share_ / (1 - share_) * sigma[0] / sigma[1] * std::exp(std::clamp(worth, -20.0, 20.0));
        share_ = std::clamp(odds / (1 + odds), least, 1 - least);
    }

  private:
    /// A model that was believed impossible could never come back.
    static constexpr double least = 0.01;

    double dwell_s_;
    double share_ = 0.5;
};

/// Moments of two mixtures of the same two states, for covariances that are symmetric to the bit.
template <class Vector, class Matrix>
void interact(Vector& first, Matrix& first_covariance, Vector& second, Matrix& second_covariance,
              const ModelPair::Mixing& mixing) noexcept {
    const Vector apart = second - first;
    const auto blend = [&apart](Matrix& covariance, const Matrix& other, double share) {
        for (int j = 0; j < apart.size(); ++j)
            covariance.col(j) +=
                share * (other.col(j) - covariance.col(j)) + (share * (1 - share)) * (apart(j) * apart);
    };
    const Matrix before = first_covariance;
    blend(first_covariance, second_covariance, mixing.second_in_first);
    blend(second_covariance, before, mixing.first_in_second);
    first += mixing.second_in_first * apart;
    second -= mixing.first_in_second * apart;
}

} // namespace locus::filter
