// The federated filter of paper 000 (section 4.2): a local UWB filter (PCA-Kalman behind Chan-Taylor), a local visual
// filter on a person's foot points, and a master that adds their information. Each local filter knows nothing of the
// other and is never set back to the master's result ("no reset" in Carlson's words): so an error of one sensor stays
// its own, and when one is blind its knowledge fades by itself until the other's is all there is, and comes back as it
// earns it. Where the two contradict each other by more than chance, nobody knows who is right: the place stays the
// weighed mean, and the covariance grows until it covers both.
// All in the plane; the tag's height is a setting.
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/estimators/federated_settings.h"
#include "fusion/estimators/foot_filter.h"

#include <optional>

namespace locus {

class Federated final : public Estimator {
  public:
    /// `site` outlives the estimator.
    Federated(const Site& site, const FederatedSettings& settings);

    /// Ranges, range differences, and foot points of whom a camera has identified with this target.
    Verdict update(const Measurement& measurement) noexcept override;
    Estimate predict(Timestamp time) const noexcept override;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<Federated>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const Federated&>(other); }

  private:
    using UwbFilter = EpochEstimator<CarriedPca>;

    Verdict hear(const Measurement& measurement) noexcept;
    Verdict see(const FootPoint& foot, const Measurement& measurement) noexcept;
    filter::PlaneKnowledge master(const filter::PlaneKnowledge& heard,
                                  const filter::PlaneKnowledge& seen) const noexcept;
    void write(const filter::PlaneKnowledge& known, Estimate& estimate) const noexcept;

    FederatedSettings settings_;
    UwbFilter uwb_;
    UwbFilter fresh_uwb_; ///< that has heard nothing yet
    FootFilter feet_;
    double chance_; ///< contradiction that chance may bring, squared
    std::optional<Timestamp> heard_;
    UsedKinds seen_;
};

std::unique_ptr<Estimator> make_federated(const Site& site, const void* settings);

inline constexpr EstimatorRow federated_row{
    "federated", "Two local filters, UWB and camera, and the sum of their information (paper 000): to compare with.",
    option_table<FederatedSettings>(all_federated_options), make_federated};

} // namespace locus
