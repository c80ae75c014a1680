// What the hypotheses about a field let expect at corners of its cells, averaged by their weight. For .cpp files of
// this room only.
#pragma once

#include "fusion/radio/field_hypotheses.h"

#include <vector>

namespace locus::radio {

/// Sums over the mixture, of all beacons and corners: weight, mean and square.
struct Moments {
    Eigen::MatrixXd weight, mean, square; ///< corners x beacons

    Moments(Eigen::Index corners, Eigen::Index beacons)
        : weight(Eigen::MatrixXd::Zero(corners, beacons)), mean(weight), square(weight) {}
    void add(Eigen::Index first, Eigen::Index beacon, double share, const Eigen::ArrayXd& mean_dbm,
             const Eigen::ArrayXd& variance_db2) {
        const Eigen::Index count = mean_dbm.size();
        weight.col(beacon).segment(first, count).array() += share;
        mean.col(beacon).segment(first, count).array() += share * mean_dbm;
        square.col(beacon).segment(first, count).array() += share * (variance_db2 + mean_dbm.square());
    }
};

void add_hypothesis(const FieldData& data, const WeightedHypothesis& given, const FloorPoints& corners_m,
                    Moments& moments);

} // namespace locus::radio
