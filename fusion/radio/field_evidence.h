// How well a hypothesis about the field explains a map: the marginal likelihood of every beacon's strengths for every
// place that it may send from (Rasmussen and Williams 2006, eq. 2.43-2.45, with level and exponent integrated out).
#pragma once

#include "fusion/radio/field_kernel.h"
#include "fusion/radio/radio_map.h"

#include <vector>

namespace locus::radio {

/// A map as matrices. Who was not heard anywhere near a point stands there with the hearing floor.
struct FieldData {
    FloorPoints points_m;
    Eigen::MatrixXd strengths_dbm;          ///< points x beacons
    std::vector<Eigen::Vector2d> sources_m; ///< where a beacon may be
    std::vector<LossBasis> bases;           ///< of the points, for each source
};

FieldData field_data(const RadioMap& map, const std::vector<Address>& beacons);

/// Every so many points and beacons, for a search whose cost goes with their cubes.
FieldData thinned(const FieldData& data, Eigen::Index most_points, Eigen::Index most_beacons);

/// One hypothesis, solved. Copies nothing of `data`, which outlives it.
class FieldEvidence {
  public:
    FieldEvidence(const FieldData& data, const FieldHypothesis& hypothesis);

    /// Logarithm, up to a constant that is the same for all: beacons x sources.
    const Eigen::MatrixXd& of_sources() const { return of_sources_; }
    /// Over all beacons, each with every source as likely before.
    double total() const;

    const Eigen::LLT<Eigen::MatrixXd>& points() const { return points_; }
    /// Level and exponent of a beacon that sends from a source, and what they are uncertain by.
    Eigen::Vector2d loss(Eigen::Index beacon, std::size_t source) const;
    Eigen::Matrix2d loss_covariance(std::size_t source) const { return solved_[source].covariance; }

  private:
    struct Solved {
        LossBasis weighted; ///< inverse covariance times basis
        Eigen::Matrix2d covariance;
    };
    const FieldData* data_;
    Eigen::LLT<Eigen::MatrixXd> points_;
    std::vector<Solved> solved_;
    Eigen::MatrixXd of_sources_;
};

} // namespace locus::radio
