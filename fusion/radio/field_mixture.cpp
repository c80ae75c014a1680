#include "fusion/radio/field_mixture.h"

#include <algorithm>

namespace locus::radio {
namespace {

constexpr Eigen::Index corners_at_a_time = 512;
/// What weighs less in a mixture is not worth its time.
constexpr double least_source = 0.003;

/// A beacon that sends from one source, under one hypothesis.
struct Part {
    double weight = 0;
    std::size_t source = 0;
    Eigen::Vector2d loss{0, 0};
    Eigen::VectorXd off_dbm; ///< of the points, from what the path loss alone lets expect
};

std::vector<Part> parts_of(const FieldData& data, const FieldEvidence& evidence, Eigen::Index beacon) {
    const Eigen::RowVectorXd logs = evidence.of_sources().row(beacon);
    const Eigen::RowVectorXd weights = (logs.array() - logs.maxCoeff()).exp();
    const double sum = weights.sum();
    std::vector<Part> parts;
    for (std::size_t s = 0; s < data.sources_m.size(); ++s) {
        const double weight = weights(static_cast<Eigen::Index>(s)) / sum;
        if (weight < least_source) continue;
        const Eigen::Vector2d loss = evidence.loss(beacon, s);
        parts.push_back({weight, s, loss, data.strengths_dbm.col(beacon) - data.bases[s] * loss});
    }
    return parts;
}

/// Rasmussen and Williams 2006, eq. 2.41-2.42.
void add_corners(const FieldData& data, const FieldEvidence& evidence, const WeightedHypothesis& given,
                 const std::vector<std::vector<Part>>& parts, const FloorPoints& corners_m, Eigen::Index first,
                 Moments& moments) {
    const FieldHypothesis& h = given.hypothesis;
    const Eigen::MatrixXd shared = shared_covariance(data.points_m, corners_m, h);
    const Eigen::MatrixXd gains = evidence.points().solve(shared);
    const Eigen::ArrayXd known = shared.cwiseProduct(gains).colwise().sum().transpose();
    const Eigen::ArrayXd left = (h.shared_db * h.shared_db - known).max(0.0) + h.own_db * h.own_db;
    for (std::size_t b = 0; b < parts.size(); ++b)
        for (const Part& part : parts[b]) {
            const LossBasis here = loss_basis(corners_m, data.sources_m[part.source]);
            const LossBasis unknown = here - gains.transpose() * data.bases[part.source];
            const Eigen::ArrayXd by_loss =
                (unknown * evidence.loss_covariance(part.source)).cwiseProduct(unknown).rowwise().sum();
            const Eigen::ArrayXd mean = here * part.loss + gains.transpose() * part.off_dbm;
            moments.add(first, static_cast<Eigen::Index>(b), given.weight * part.weight, mean, left + by_loss);
        }
}

} // namespace

void add_hypothesis(const FieldData& data, const WeightedHypothesis& given, const FloorPoints& corners_m,
                    Moments& moments) {
    const FieldEvidence evidence(data, given.hypothesis);
    std::vector<std::vector<Part>> parts;
    for (Eigen::Index b = 0; b < data.strengths_dbm.cols(); ++b) parts.push_back(parts_of(data, evidence, b));
    for (Eigen::Index first = 0; first < corners_m.rows(); first += corners_at_a_time) {
        const Eigen::Index count = std::min(corners_at_a_time, corners_m.rows() - first);
        add_corners(data, evidence, given, parts, corners_m.middleRows(first, count), first, moments);
    }
}

} // namespace locus::radio
