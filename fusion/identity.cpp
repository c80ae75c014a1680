#include "fusion/identity.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

using Tag = std::optional<Address>;

Delivery from_one(Tag tag, SourceKind kind, Address source) { return {tag, kind, {source, no_address}, 1}; }

Deliveries one(Tag tag, SourceKind kind, Address source) { return {{from_one(tag, kind, source), {}}, 1}; }

Deliveries of_two_anchors(Tag tag, Address anchor, Address other) {
    return {{Delivery{tag, SourceKind::anchor, {anchor, other}, 2}, {}}, 1};
}

/// Satellites of all constellations in one number space.
template <class Sample>
Address satellite_address(const Sample& sample) {
    return address(sample.constellation * 256u + sample.satellite);
}

struct WhomItConcerns {
    std::uint16_t input;
    const Site& site;

    Address this_input() const { return address(input); }

    Deliveries operator()(const Range& o) const { return one(o.tag, SourceKind::anchor, o.anchor); }
    Deliveries operator()(const RangeDifference& o) const { return of_two_anchors(o.tag, o.anchor_a, o.anchor_b); }
    Deliveries operator()(const Arrival& o) const { return one(o.tag, SourceKind::anchor, o.anchor); }
    Deliveries operator()(const ClockSync& o) const {
        return {{from_one({}, SourceKind::anchor, o.receiver), from_one({}, SourceKind::anchor, o.transmitter)}, 2};
    }
    Deliveries operator()(const PeerRange& o) const {
        return {{from_one(o.tag_a, SourceKind::tag, o.tag_b), from_one(o.tag_b, SourceKind::tag, o.tag_a)}, 2};
    }
    Deliveries operator()(const ImuSample& o) const { return one(o.tag, SourceKind::imu, o.tag); }
    Deliveries operator()(const FootPoint& o) const { return one({}, SourceKind::camera, o.camera); }
    Deliveries operator()(const VisualOdometry& o) const {
        return one(o.tag == no_address ? Tag{} : Tag{o.tag}, SourceKind::camera, o.camera);
    }
    Deliveries operator()(const GnssFix& o) const { return one(o.tag, SourceKind::input, this_input()); }
    Deliveries operator()(const GnssRaw& o) const { return one(o.tag, SourceKind::satellite, satellite_address(o)); }
    Deliveries operator()(const WheelSpeed& o) const { return one(o.tag, SourceKind::vehicle, o.tag); }
    Deliveries operator()(const Pressure& o) const { return one(o.tag, SourceKind::input, this_input()); }
    Deliveries operator()(const Heading& o) const { return one(o.tag, SourceKind::heading, o.tag); }
    Deliveries operator()(const SignalStrength& o) const {
        const Address beacon = beacon_of(o, site);
        return one(beacon == o.receiver ? o.transmitter : o.receiver, SourceKind::beacon, beacon);
    }
    Deliveries operator()(const GnssNavigation& o) const {
        return one(o.tag, SourceKind::satellite, satellite_address(o));
    }
    Deliveries operator()(const Height& o) const { return one(o.tag, SourceKind::input, this_input()); }
    Deliveries operator()(const GnssBaseRange& o) const { return one({}, SourceKind::base, o.base); }
    Deliveries operator()(const SatelliteRange& o) const {
        return one(o.tag, SourceKind::satellite, satellite_address(o));
    }
};

template <class Numbers>
bool all_finite(const Numbers& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](auto number) { return std::isfinite(number); });
}

struct NumbersAreFinite {
    bool operator()(const Range& o) const { return std::isfinite(o.range_m); }
    bool operator()(const RangeDifference& o) const { return std::isfinite(o.difference_m); }
    bool operator()(const Arrival&) const { return true; }
    bool operator()(const ClockSync&) const { return true; }
    bool operator()(const PeerRange& o) const { return std::isfinite(o.range_m); }
    bool operator()(const ImuSample& o) const {
        return all_finite(o.specific_force_mps2) && all_finite(o.angular_rate_radps);
    }
    bool operator()(const FootPoint& o) const { return all_finite(o.position_site_m) && all_finite(o.covariance_m2); }
    bool operator()(const VisualOdometry& o) const {
        return all_finite(o.position_odometry) && all_finite(o.orientation_xyzw);
    }
    bool operator()(const GnssFix& o) const {
        return all_finite(Vec3{o.latitude_deg, o.longitude_deg, o.height_ellipsoid_m});
    }
    bool operator()(const GnssRaw& o) const {
        return all_finite(std::array{o.receiver_time_s_in_gps_week, o.pseudorange_m, o.carrier_cycles, o.doppler_hz});
    }
    bool operator()(const GnssBaseRange& o) const {
        return std::isfinite(o.time_s_in_gps_week) && std::isfinite(o.pseudorange_m);
    }
    bool operator()(const WheelSpeed& o) const { return std::isfinite(o.speed_mps); }
    bool operator()(const Pressure& o) const { return std::isfinite(o.pressure_pa); }
    bool operator()(const Heading& o) const { return std::isfinite(o.heading_deg); }
    bool operator()(const SignalStrength& o) const { return std::isfinite(o.rssi_dbm); }
    bool operator()(const GnssNavigation&) const { return true; }
    bool operator()(const Height& o) const { return std::isfinite(o.height_site_m); }
    bool operator()(const SatelliteRange& o) const {
        return all_finite(o.satellite_ecef_m) && all_finite(o.satellite_velocity_ecef_mps) &&
               std::isfinite(o.pseudorange_m) && std::isfinite(o.carrier_m);
    }
};

struct ShownValue {
    double operator()(const Range& o) const { return o.range_m; }
    double operator()(const RangeDifference& o) const { return o.difference_m; }
    double operator()(const PeerRange& o) const { return o.range_m; }
    double operator()(const GnssRaw& o) const { return o.pseudorange_m; }
    double operator()(const SatelliteRange& o) const { return o.pseudorange_m; }
    double operator()(const GnssBaseRange& o) const { return o.pseudorange_m; }
    double operator()(const WheelSpeed& o) const { return o.speed_mps; }
    double operator()(const Pressure& o) const { return o.pressure_pa; }
    double operator()(const Heading& o) const { return o.heading_deg; }
    double operator()(const Height& o) const { return o.height_site_m; }
    double operator()(const SignalStrength& o) const { return static_cast<double>(o.rssi_dbm); }
    template <class Other>
    double operator()(const Other&) const {
        return 0;
    }
};

} // namespace

// NOLINTBEGIN(bugprone-exception-escape): all alternatives are trivial, so the variant never loses its value
Address beacon_of(const SignalStrength& strength, const Site& site) noexcept {
    return site.find_anchor(strength.receiver) != nullptr ? strength.receiver : strength.transmitter;
}

Deliveries deliveries_of(const Measurement& measurement, const Site& site) noexcept {
    return std::visit(WhomItConcerns{measurement.input, site}, measurement.observation);
}

bool keep_strangers(Delivery& delivery, const Site& site) noexcept {
    if (delivery.kind != SourceKind::anchor) return false;
    const auto begin = delivery.sources.begin(), end = begin + static_cast<std::ptrdiff_t>(delivery.source_count);
    const auto known = [&](Address source) { return site.find_anchor(source) != nullptr; };
    if (std::all_of(begin, end, known)) return false;
    delivery.source_count = static_cast<std::size_t>(std::remove_if(begin, end, known) - begin);
    return true;
}

bool is_finite(const Observation& observation) noexcept { return std::visit(NumbersAreFinite{}, observation); }

double shown_value(const Observation& observation) noexcept { return std::visit(ShownValue{}, observation); }
// NOLINTEND(bugprone-exception-escape)

} // namespace locus
