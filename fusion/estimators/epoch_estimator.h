// An estimator that looks at positions instead of measurements: Chan-Taylor makes one of each epoch, and a filter takes
// it in. The position of an epoch that still lasts changes with every measurement; so the filter as it was before the
// epoch is kept, and takes each newer position of the epoch in the place of the older.
#pragma once

#include "fusion/estimators/epoch_gatherer.h"
#include "fusion/estimators/estimator.h"
#include "fusion/geometry/vector.h"

#include <Eigen/Core>

namespace locus {

/// `Filter` has a type Settings derived from EpochEstimatorSettings, a reach, and is made from Settings; it has
/// take(position, covariance, time) and write(time, estimate), and copies without allocation.
template <class Filter>
class EpochEstimator final : public Estimator {
  public:
    using Settings = typename Filter::Settings;

    /// `site` outlives the estimator.
    EpochEstimator(const Site& site, const Settings& settings)
        : gatherer_(site, settings, Filter::reach), before_(settings), now_(settings) {}

    Verdict update(const Measurement& measurement) noexcept override {
        const EpochGatherer::News news = gatherer_.take(measurement);
        if (news.opens_epoch) before_ = now_;
        if (news.fix) {
            now_ = before_;
            now_.take(vector(news.fix->position_site_m), Eigen::Matrix3d(news.fix->covariance_m2.data()),
                      measurement.time);
        }
        return {news.reason};
    }

    Estimate predict(Timestamp time) const noexcept override {
        Estimate estimate;
        gatherer_.describe(time, estimate);
        if (estimate.missing == Missing::nothing) now_.write(time, estimate);
        return estimate;
    }

    std::unique_ptr<Estimator> clone() const override { return std::make_unique<EpochEstimator>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const EpochEstimator&>(other); }

  private:
    EpochGatherer gatherer_;
    Filter before_; ///< without the epoch that lasts
    Filter now_;
};

template <class Filter>
std::unique_ptr<Estimator> make_epoch_estimator(const Site& site, const void* settings) {
    return std::make_unique<EpochEstimator<Filter>>(site, *static_cast<const typename Filter::Settings*>(settings));
}

} // namespace locus
