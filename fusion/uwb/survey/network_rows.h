// The pairs of a network as rows of least squares.
#pragma once

#include "fusion/uwb/survey/network.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace locus::uwb::survey {

/// The sought coordinates as one vector: number of each, or -1.
struct Unknowns {
    explicit Unknowns(const Sought& sought) : number(sought.rows(), 3) {
        for (Eigen::Index station = 0; station < sought.rows(); ++station)
            for (int axis = 0; axis < 3; ++axis) number(station, axis) = sought(station, axis) ? count++ : -1;
    }
    Eigen::Array<Eigen::Index, Eigen::Dynamic, 3> number;
    Eigen::Index count = 0;
};

struct Normal {
    Eigen::MatrixXd information;
    Eigen::VectorXd projection;
    double cost = 0;
};

/// A pair's row: gradient by the six coordinates of its ends, over its sigma.
struct PairRow {
    std::array<Eigen::Index, 6> unknown{};
    Eigen::Matrix<double, 6, 1> slope;
    double residual = 0;
};

PairRow row_of(const PairRange& pair, const Unknowns& unknowns, const Positions& at_m);

/// Whether it joins two of so many stations, with a range and a sigma that are numbers.
bool usable(const PairRange& pair, Eigen::Index stations);

/// Sum over the pairs, Cauchy weights of `scale` standard deviations.
Normal linearise(const std::vector<PairRange>& pairs, const Unknowns& unknowns, const Positions& at_m, double scale);
double cost_at(const std::vector<PairRange>& pairs, const Positions& at_m, double scale);

} // namespace locus::uwb::survey
