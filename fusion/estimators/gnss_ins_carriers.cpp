// Satellites' carriers: an epoch is weighed when time goes on from it, all of its changes together, because a slip
// shows against the other satellites; then the place where it was is held for the next.
#include "fusion/estimators/gnss_ins.h"
#include "fusion/geometry/vector.h"

#include <array>

namespace locus {
namespace {

/// Over longer, the place that is held is of no use: a change says little that the codes at both ends do not.
constexpr double longest_change_s = 5;

gnss::CarrierEquation equation_of(const GnssInsScalar& change) {
    const auto by_axis = [&](int axis) { return change.jacobian(GnssInsTrack::place(axis, 0)); };
    return {{by_axis(0), by_axis(1), by_axis(2), 1}, change.innovation, change.variance};
}

} // namespace

/// Verdicts tell what became of the change before: that of now is weighed when the epoch is over.
CarrierUse GnssIns::hear_carrier(const SatelliteRange& range, Timestamp time) noexcept {
    if (!settings().use_carrier || range.carrier_m == 0) return CarrierUse::none;
    const gnss::CarrierSight sight = observations_->carrier(track_, range);
    carriers_.hear(sight, time);
    const gnss::CarrierSight* const before = carriers_.before(sight);
    return before == nullptr ? CarrierUse::new_lock : before->use;
}

void GnssIns::finish_epoch() noexcept {
    if (!carriers_.is_waiting()) return;
    if (carriers_.has_before() && carriers_.since_before_s() <= longest_change_s && track_.held_place()[0] >= 0)
        use_carriers();
    track_.hold_place(vector(settings().gnss_antenna_body_m));
    carriers_.turn_over();
}

/// Whether the carrier's change can be used as far as it shows by itself.
CarrierUse GnssIns::look_at(const gnss::CarrierSight& now) const noexcept {
    const gnss::CarrierSight* const before = carriers_.before(now);
    const double dt_s = carriers_.since_before_s();
    if (before == nullptr || !is_unbroken(*before, now, dt_s)) return CarrierUse::new_lock;
    return agrees_with_doppler(*before, now, dt_s, gate_in_sigma_) ? CarrierUse::used : CarrierUse::slipped;
}

void GnssIns::use_carriers() noexcept {
    const auto change = [&](const gnss::CarrierSight& now) {
        return observations_->carrier_change(track_, *carriers_.before(now), now, carriers_.since_before_s());
    };
    std::array<gnss::CarrierEquation, GnssInsCarriers::room> equations;
    std::array<gnss::CarrierSight*, GnssInsCarriers::room> whose{};
    std::size_t count = 0;
    for (gnss::CarrierSight& now : carriers_.waiting()) {
        now.use = look_at(now);
        if (now.use != CarrierUse::used) continue;
        equations[count] = equation_of(change(now));
        whose[count++] = &now;
    }
    gnss::leave_out_slips(std::span(equations).first(count), consistency_quantile_);
    for (std::size_t i = 0; i < count; ++i) {
        filter::Gate once; // a slip is over with its epoch: there is nobody to be patient with
        const bool used = equations[i].agrees && weigh(Aid::carrier, change(*whose[i]), once).reason == Exclusion::none;
        whose[i]->use = used ? CarrierUse::used : CarrierUse::slipped;
    }
}

} // namespace locus
