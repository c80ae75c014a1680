#include "fusion/estimators/range_ekf.h"

namespace locus {

filter::TrackModel track_model(const RangeEkfSettings& s) {
    return {{s.acceleration_sigma_mps2, s.acceleration_time_s}, s.speed_sigma_mps, s.planar};
}

RangeEkf::RangeEkf(const Site& site, const RangeEkfSettings& settings)
    : RangeFilter(site, settings, filter::TrackState(track_model(settings))) {}

std::unique_ptr<Estimator> make_range_ekf(const Site& site, const void* settings) {
    return std::make_unique<RangeEkf>(site, *static_cast<const RangeEkfSettings*>(settings));
}

} // namespace locus
