#include "fusion/estimators/range_expectation.h"

#include "fusion/estimators/carried_keys.h"
#include "fusion/estimators/nav_track.h"
#include "fusion/filter/track_state.h"

#include <array>

namespace locus {
namespace {

struct Carried {
    int place = -1; ///< in the state; -1: there is none
    double sign = 1;
};

template <class Track>
Carried carry(std::int32_t key, double sign, const filter::WanderModel& model, Track& track) {
    return {model.sigma > 0 ? track.wanderer(key, model) : -1, sign};
}

} // namespace

template <class Track>
RangeExpectation<Track> expect(const uwb::Sighting& sighting, const Site& site, const CarriedErrors& errors,
                               Track& track) noexcept {
    const bool alone = sighting.is_range();
    const std::array all{carry(carried::passing(sighting.plus), 1, errors.anchor, track),
                         alone ? carry(carried::common_range, 1, errors.common, track)
                               : carry(carried::passing(sighting.minus), -1, errors.anchor, track),
                         alone ? carry(carried::offset(sighting.plus), 1, errors.offset, track) : Carried{}};
    RangeExpectation<Track> expectation;
    expectation.jacobian.setZero(track.size());
    const Eigen::Vector3d antenna_site_m = track.antenna_site_m();
    track.spread_gradient(uwb::gradient(sighting, site, antenna_site_m), expectation.jacobian);
    double predicted_m = uwb::predicted_m(sighting, site, antenna_site_m);
    for (const Carried& error : all) {
        if (error.place < 0) continue;
        expectation.jacobian(error.place) = error.sign;
        predicted_m += error.sign * track.state(error.place);
    }
    expectation.innovation_m = sighting.value_m - predicted_m;
    return expectation;
}

template RangeExpectation<filter::TrackState> expect(const uwb::Sighting&, const Site&, const CarriedErrors&,
                                                     filter::TrackState&) noexcept;
template RangeExpectation<NavTrack> expect(const uwb::Sighting&, const Site&, const CarriedErrors&, NavTrack&) noexcept;

} // namespace locus
