// Poses of a whole recording with what came before and what came after each of them: the engine runs through it twice,
// once backwards, and where both have a pose the two are weighed by how sure they are (Fraser and Potter 1969, "The
// optimum linear smoother as a combination of two optimum linear filters"). It needs nothing of an estimator but that
// it runs, so all of them can be smoothed.
#pragma once

#include "fusion/engine.h"

#include <functional>
#include <string>
#include <vector>

namespace locus::replay {

/// Of one target at one time; both estimates have a position. The covariance is that of the surer one: what anchors
/// hold for a while is in the past and in the future alike, so the two are not independent and their sum promises too
/// much (on recordings the bound then held for 70 to 100 % of the poses instead of 95).
Estimate combined(const Estimate& before, const Estimate& after);

class Smoother {
  public:
    explicit Smoother(const EngineSettings& settings) : settings_(settings) {}

    void keep(const Measurement& measurement) { measurements_.push_back(measurement); }
    /// What the engine gave on the way forwards.
    void keep(const Pose& pose, const std::string& target) { poses_.push_back({pose, target}); }

    /// Gives the poses that were kept, in their order and smoothed.
    void finish(const std::function<void(const Pose&, const std::string&)>& take);

    /// Measurements that cannot be run backwards (raw arrivals, raw GNSS signals); what they say is in the forward run
    /// only.
    std::uint64_t one_way() const { return one_way_; }

  private:
    struct Named {
        Pose pose;
        std::string target;
    };
    std::vector<Named> backwards();

    const EngineSettings& settings_;
    std::vector<Measurement> measurements_;
    std::vector<Named> poses_;
    std::uint64_t one_way_ = 0;
};

} // namespace locus::replay
