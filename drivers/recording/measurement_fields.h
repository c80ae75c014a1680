// The one table of what each Measurement kind holds: the JSON writer and the reader both walk it, so they cannot
// disagree. A visitor has must(name, value) for what every sample has, and may(name, value) for what a device need not
// say (unknown: NaN, LineOfSight::unknown, no_address or no Looks), and gone(name) for what older recordings have.
// Names are those of fusion/measurement.h.
#pragma once

#include "fusion/measurement.h"

#include <concepts>
#include <type_traits>

namespace locus {

/// T is Kind, const or not: one function both reads and fills a struct.
template <class T, class Kind>
concept Of = std::same_as<std::remove_const_t<T>, Kind>;

template <class Visitor, Of<Range> Kind>
void visit_fields(Visitor& visit, Kind& range) {
    visit.must("anchor", range.anchor);
    visit.must("tag", range.tag);
    visit.must("range_m", range.range_m);
    visit.may("sigma_m", range.sigma_m);
    visit.may("rx_power_dbm", range.rx_power_dbm);
    visit.may("first_path_power_dbm", range.first_path_power_dbm);
    visit.may("line_of_sight", range.line_of_sight);
}

template <class Visitor, Of<RangeDifference> Kind>
void visit_fields(Visitor& visit, Kind& difference) {
    visit.must("anchor_a", difference.anchor_a);
    visit.must("anchor_b", difference.anchor_b);
    visit.must("tag", difference.tag);
    visit.must("difference_m", difference.difference_m);
    visit.may("sigma_m", difference.sigma_m);
    visit.may("line_of_sight", difference.line_of_sight);
}

template <class Visitor, Of<Arrival> Kind>
void visit_fields(Visitor& visit, Kind& arrival) {
    visit.must("anchor", arrival.anchor);
    visit.must("tag", arrival.tag);
    visit.must("rx_anchor_ticks_in_anchor", arrival.rx_anchor_ticks_in_anchor);
    visit.must("blink_sequence", arrival.sequence);
    visit.may("rx_power_dbm", arrival.rx_power_dbm);
    visit.may("first_path_power_dbm", arrival.first_path_power_dbm);
}

template <class Visitor, Of<ClockSync> Kind>
void visit_fields(Visitor& visit, Kind& sync) {
    visit.must("transmitter", sync.transmitter);
    visit.must("receiver", sync.receiver);
    visit.must("tx_transmitter_ticks_in_transmitter", sync.tx_transmitter_ticks_in_transmitter);
    visit.must("rx_receiver_ticks_in_receiver", sync.rx_receiver_ticks_in_receiver);
    visit.must("sync_sequence", sync.sequence);
}

template <class Visitor, Of<PeerRange> Kind>
void visit_fields(Visitor& visit, Kind& range) {
    visit.must("tag_a", range.tag_a);
    visit.must("tag_b", range.tag_b);
    visit.must("range_m", range.range_m);
    visit.may("sigma_m", range.sigma_m);
}

template <class Visitor, Of<ImuSample> Kind>
void visit_fields(Visitor& visit, Kind& imu) {
    visit.must("tag", imu.tag);
    visit.must("specific_force_mps2", imu.specific_force_mps2);
    visit.must("angular_rate_radps", imu.angular_rate_radps);
    visit.may("magnetic_field_ut", imu.magnetic_field_ut);
}

template <class Visitor, Of<FootPoint> Kind>
void visit_fields(Visitor& visit, Kind& foot) {
    visit.must("camera", foot.camera);
    visit.must("track", foot.track);
    visit.must("position_site_m", foot.position_site_m);
    visit.must("covariance_m2", foot.covariance_m2);
    visit.may("confidence", foot.confidence);
    visit.may("looks", foot.looks);
    visit.gone("appearance_slot"); // of a pool that never was
}

template <class Visitor, Of<VisualOdometry> Kind>
void visit_fields(Visitor& visit, Kind& odometry) {
    visit.must("camera", odometry.camera);
    visit.must("segment", odometry.segment);
    visit.must("position_odometry", odometry.position_odometry);
    visit.must("orientation_xyzw", odometry.orientation_xyzw);
    visit.may("tag", odometry.tag);
}

template <class Visitor, Of<GnssFix> Kind>
void visit_fields(Visitor& visit, Kind& fix) {
    visit.must("tag", fix.tag);
    visit.must("latitude_deg", fix.latitude_deg);
    visit.must("longitude_deg", fix.longitude_deg);
    visit.must("height_ellipsoid_m", fix.height_ellipsoid_m);
    visit.may("velocity_enu_mps", fix.velocity_enu_mps);
    visit.may("sigma_horizontal_m", fix.sigma_horizontal_m);
    visit.may("sigma_vertical_m", fix.sigma_vertical_m);
    visit.may("sigma_velocity_mps", fix.sigma_velocity_mps);
    visit.must("fix_type", fix.fix_type);
    visit.must("satellites", fix.satellites);
}

template <class Visitor, Of<GnssRaw> Kind>
void visit_fields(Visitor& visit, Kind& raw) {
    visit.must("tag", raw.tag);
    visit.must("receiver_time_s_in_gps_week", raw.receiver_time_s_in_gps_week);
    visit.must("pseudorange_m", raw.pseudorange_m);
    visit.must("carrier_cycles", raw.carrier_cycles);
    visit.must("doppler_hz", raw.doppler_hz);
    visit.may("sigma_pseudorange_m", raw.sigma_pseudorange_m);
    visit.may("carrier_to_noise_dbhz", raw.carrier_to_noise_dbhz);
    visit.must("lock_s", raw.lock_s);
    visit.must("gps_week", raw.gps_week);
    visit.must("constellation", raw.constellation);
    visit.must("satellite", raw.satellite);
    visit.must("signal", raw.signal);
    visit.must("glonass_slot", raw.glonass_slot);
}

template <class Visitor, Of<SatelliteRange> Kind>
void visit_fields(Visitor& visit, Kind& range) {
    visit.must("tag", range.tag);
    visit.must("satellite_ecef_m", range.satellite_ecef_m);
    visit.must("satellite_velocity_ecef_mps", range.satellite_velocity_ecef_mps);
    visit.may("range_rate_mps", range.range_rate_mps);
    visit.must("pseudorange_m", range.pseudorange_m);
    visit.must("carrier_m", range.carrier_m);
    visit.may("sigma_m", range.sigma_m);
    visit.may("sigma_rate_mps", range.sigma_rate_mps);
    visit.may("carrier_to_noise_dbhz", range.carrier_to_noise_dbhz);
    visit.must("lock_s", range.lock_s);
    visit.must("constellation", range.constellation);
    visit.must("satellite", range.satellite);
    visit.must("signal", range.signal);
}

template <class Visitor, Of<GnssBaseRange> Kind>
void visit_fields(Visitor& visit, Kind& range) {
    visit.must("base", range.base);
    visit.must("time_s_in_gps_week", range.time_s_in_gps_week);
    visit.must("pseudorange_m", range.pseudorange_m);
    visit.may("antenna_ecef_m", range.antenna_ecef_m);
    visit.may("carrier_to_noise_dbhz", range.carrier_to_noise_dbhz);
    visit.must("constellation", range.constellation);
    visit.must("satellite", range.satellite);
    visit.must("signal", range.signal);
    visit.must("glonass_slot", range.glonass_slot);
}

template <class Visitor, Of<Heading> Kind>
void visit_fields(Visitor& visit, Kind& heading) {
    visit.must("tag", heading.tag);
    visit.must("heading_deg", heading.heading_deg);
    visit.may("sigma_deg", heading.sigma_deg);
    visit.may("baseline_m", heading.baseline_m);
}

template <class Visitor, Of<WheelSpeed> Kind>
void visit_fields(Visitor& visit, Kind& wheel) {
    visit.must("tag", wheel.tag);
    visit.must("speed_mps", wheel.speed_mps);
    visit.may("sigma_mps", wheel.sigma_mps);
    visit.may("yaw_rate_radps", wheel.yaw_rate_radps);
    visit.may("steering_rad", wheel.steering_rad);
}

template <class Visitor, Of<Pressure> Kind>
void visit_fields(Visitor& visit, Kind& pressure) {
    visit.must("tag", pressure.tag);
    visit.must("pressure_pa", pressure.pressure_pa);
    visit.may("temperature_c", pressure.temperature_c);
}

template <class Visitor, Of<Height> Kind>
void visit_fields(Visitor& visit, Kind& height) {
    visit.must("tag", height.tag);
    visit.must("height_site_m", height.height_site_m);
    visit.may("sigma_m", height.sigma_m);
}

template <class Visitor, Of<SignalStrength> Kind>
void visit_fields(Visitor& visit, Kind& strength) {
    visit.must("transmitter", strength.transmitter);
    visit.must("receiver", strength.receiver);
    visit.must("rssi_dbm", strength.rssi_dbm);
    visit.may("tx_power_dbm", strength.tx_power_dbm);
    visit.must("channel", strength.channel);
}

template <class Visitor, Of<GnssNavigation> Kind>
void visit_fields(Visitor& visit, Kind& navigation) {
    visit.must("tag", navigation.tag);
    visit.must("constellation", navigation.constellation);
    visit.must("satellite", navigation.satellite);
    visit.must("signal", navigation.signal);
    visit.must("glonass_slot", navigation.glonass_slot);
    visit.must("word_count", navigation.word_count);
    visit.must("words", navigation.words);
}

} // namespace locus
