// Satellites' carriers: an epoch is weighed when time goes on from it, all of its changes together, because a slip
// shows against the other satellites; then the place where it was is held for the next.
#include "fusion/estimators/gnss_ins.h"
#include "fusion/geometry/vector.h"

#include <span>

namespace locus {
namespace {

/// Over longer, the place that is held is of no use: a change says little that the codes at both ends do not.
constexpr double longest_change_s = 5;

gnss::CarrierEquation equation_of(const GnssInsScalar& change) {
    const auto by_axis = [&](int axis) { return change.jacobian(GnssInsTrack::place(axis, 0)); };
    gnss::CarrierEquation equation;
    equation.row << by_axis(0), by_axis(1), by_axis(2), 1;
    equation.residual_m = change.innovation;
    equation.variance_m2 = change.variance;
    return equation;
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

/// Of the satellites whose lock held; `whose` says whose they are.
std::size_t GnssIns::changes(CarrierEquations& equations, CarrierOwners& whose) noexcept {
    const double dt_s = carriers_.since_before_s();
    std::size_t count = 0;
    for (gnss::CarrierSight& now : carriers_.waiting()) {
        const gnss::CarrierSight* const before = carriers_.before(now);
        now.use = CarrierUse::new_lock;
        if (before == nullptr || !is_unbroken(*before, now, dt_s)) continue;
        equations[count] = equation_of(observations_->carrier_change(track_, *before, now, dt_s));
        equations[count].beyond_m = beyond_doppler_m(*before, now, dt_s);
        equations[count].beyond_sigma_m = beyond_doppler_sigma_m(*before, now, dt_s);
        whose[count++] = &now;
    }
    return count;
}

void GnssIns::use_carriers() noexcept {
    CarrierEquations equations;
    CarrierOwners whose{};
    const auto all = std::span(equations).first(changes(equations, whose));
    gnss::leave_out_against_doppler(all, gate_in_sigma_);
    gnss::leave_out_slips(all, consistency_quantile_);
    for (std::size_t i = 0; i < all.size(); ++i)
        whose[i]->use = all[i].agrees && take_change(*whose[i]) ? CarrierUse::used : CarrierUse::slipped;
}

bool GnssIns::take_change(const gnss::CarrierSight& now) noexcept {
    const gnss::CarrierSight& before = *carriers_.before(now);
    filter::Gate once; // a slip is over with its epoch: there is nobody to be patient with
    const auto change = observations_->carrier_change(track_, before, now, carriers_.since_before_s());
    return weigh(Aid::carrier, change, once).reason == Exclusion::none;
}

} // namespace locus
