// UBX messages into measurements.
#include "drivers/gnss/ubx.h"

#include "drivers/frame_decoder.h"
#include "drivers/gnss/epoch_clock.h"
#include "drivers/gnss/half_cycles.h"
#include "drivers/gnss/ubx_messages.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss {
namespace {

using namespace ubx;

constexpr std::int64_t ns_per_ms = 1'000'000;
constexpr std::int32_t quarter_turn_1e7_deg = 900'000'000;
constexpr double whole_turn_deg = 360;
constexpr std::uint8_t time_only = 5;
constexpr std::size_t relative_length_of_m8p = 40; // version 0, which tells no heading
constexpr double week_s = 604800;
constexpr double farthest_m = 1e8; // twice the way to a geostationary satellite

std::uint8_t fix_type(const NavPvt& pvt) {
    if (pvt.carrier_solution() == 2) return gnss_fix_type::carrier_fixed;
    if (pvt.carrier_solution() == 1) return gnss_fix_type::carrier_float;
    if (pvt.differential() && pvt.fix_type == gnss_fix_type::full) return gnss_fix_type::differential;
    return pvt.fix_type;
}

bool possible(const NavPvt& pvt) {
    return std::abs(std::int64_t{pvt.latitude_1e7_deg}) <= quarter_turn_1e7_deg &&
           std::abs(std::int64_t{pvt.longitude_1e7_deg}) <= 2 * std::int64_t{quarter_turn_1e7_deg};
}

float metres(std::int64_t millimetres) { return static_cast<float>(static_cast<double>(millimetres) * 1e-3); }

GnssFix fix_of(const NavPvt& pvt, Address tag) {
    GnssFix fix;
    fix.tag = tag;
    fix.latitude_deg = pvt.latitude_1e7_deg * 1e-7;
    fix.longitude_deg = pvt.longitude_1e7_deg * 1e-7;
    fix.height_ellipsoid_m = pvt.height_ellipsoid_mm * 1e-3;
    const auto [north, east, down] = pvt.velocity_ned_mmps;
    fix.velocity_enu_mps = {metres(east), metres(north), metres(-std::int64_t{down})};
    fix.sigma_horizontal_m = metres(pvt.sigma_horizontal_mm);
    fix.sigma_vertical_m = metres(pvt.sigma_vertical_mm);
    fix.sigma_velocity_mps = metres(pvt.sigma_speed_mmps);
    fix.fix_type = fix_type(pvt);
    fix.satellites = pvt.satellites;
    return fix;
}

/// A line to a base station far off is no heading of a vehicle, and one whose cycles are not settled points anywhere.
bool tells_heading(const RelativePosition& relative) {
    return relative.fix_ok() && relative.way_valid() && relative.base_moves() && relative.heading_valid() &&
           relative.carrier_solution() == 2;
}

Heading heading_of(const RelativePosition& relative, Address tag) {
    Heading heading;
    heading.tag = tag;
    heading.heading_deg = relative.heading_1e5_deg * 1e-5;
    heading.sigma_deg = static_cast<float>(relative.sigma_heading_1e5_deg * 1e-5);
    heading.baseline_m = static_cast<float>(relative.length_cm * 1e-2 + relative.length_rest_1e4_m * 1e-4);
    return heading;
}

bool possible(const Heading& heading) { return heading.heading_deg >= 0 && heading.heading_deg <= whole_turn_deg; }

bool possible(const RawEpoch& epoch) {
    return epoch.receiver_time_s >= -1 && epoch.receiver_time_s <= week_s + 1; // its clock may be off by a little
}

bool possible(const RawSignal& signal) {
    return signal.pseudorange_m > 0 && signal.pseudorange_m < farthest_m && std::isfinite(signal.carrier_cycles) &&
           std::isfinite(signal.doppler_hz);
}

GnssRaw raw_of(const RawEpoch& epoch, const RawSignal& signal, Address tag) {
    GnssRaw raw;
    raw.tag = tag;
    raw.receiver_time_s_in_gps_week = epoch.receiver_time_s;
    raw.gps_week = epoch.gps_week;
    raw.pseudorange_m = signal.pseudorange_m;
    raw.carrier_cycles = signal.carrier_valid() ? signal.carrier_cycles : 0;
    raw.doppler_hz = static_cast<double>(signal.doppler_hz);
    raw.sigma_pseudorange_m = std::ldexp(0.01f, signal.sigma_pseudorange & 15);
    raw.carrier_to_noise_dbhz = static_cast<float>(signal.carrier_to_noise_dbhz);
    // When the receiver sets its clock, every carrier jumps: to who reads lock_s, a lock that begins anew.
    raw.lock_s = epoch.clock_was_reset() || !signal.carrier_valid() ? 0 : metres(signal.lock_ms);
    raw.constellation = signal.constellation;
    raw.satellite = signal.satellite;
    raw.signal = signal.signal;
    raw.glonass_slot = signal.glonass_slot;
    return raw;
}

GnssNavigation navigation_of(const Subframe& subframe, Address tag) {
    GnssNavigation navigation;
    navigation.tag = tag;
    navigation.constellation = subframe.constellation;
    navigation.satellite = subframe.satellite;
    navigation.signal = subframe.signal;
    navigation.glonass_slot = subframe.glonass_slot;
    navigation.word_count = subframe.word_count;
    std::copy_n(subframe.words.begin(), navigation.words.size(), navigation.words.begin());
    return navigation;
}

class Ubx : public FrameDecoder<ubx::Format> {
  public:
    explicit Ubx(const UbxSettings& settings) : tag_{settings.tag}, use_receiver_time_{settings.use_receiver_time} {}

    void reset() override {
        FrameDecoder::reset();
        clock_.reset();
        half_cycles_.forget();
    }

  private:
    Address tag_;
    bool use_receiver_time_;
    EpochClock clock_{EpochClock::week_ns};
    HalfCycles half_cycles_;

    void frame(const Frame& frame, MeasurementSink& sink) override {
        const wire::Bytes payload = payload_of(frame.bytes);
        switch (message_id(frame.bytes)) {
        case NavPvt::id:
            return whole(parse_nav_pvt(payload), frame, sink);
        case RelativePosition::id:
            if (payload.size() == relative_length_of_m8p) return sink.frame(frame.bytes);
            return whole(parse_relative_position(payload), frame, sink);
        case RawEpoch::id:
            return whole(parse_raw_epoch(payload), frame, sink);
        case Subframe::id:
            return whole(parse_subframe(payload), frame, sink);
        case SensorReport::id:
            return whole(parse_sensor_report(payload), frame, sink);
        default:
            return sink.frame(frame.bytes);
        }
    }

    template <class Message>
    void whole(const std::optional<Message>& message, const Frame& frame, MeasurementSink& sink) {
        if (!message) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        give(*message, frame, sink);
    }

    /// A time that the receiver itself does not hold valid would make the clock begin anew.
    Timestamp time_of(const NavPvt& pvt, const Frame& frame) {
        if (!use_receiver_time_ || !pvt.time_valid()) return frame.begun;
        return clock_.host_time(pvt.time_of_week_ms * ns_per_ms, frame.begun);
    }

    Timestamp time_of(const RelativePosition& relative, const Frame& frame) {
        if (!use_receiver_time_) return frame.begun;
        return clock_.host_time(relative.time_of_week_ms * ns_per_ms, frame.begun);
    }

    Timestamp time_of(const RawEpoch& epoch, const Frame& frame) {
        if (!use_receiver_time_) return frame.begun;
        return clock_.host_time(std::llround(epoch.receiver_time_s * 1e9), frame.begun);
    }

    void give(const NavPvt& pvt, const Frame& frame, MeasurementSink& sink) {
        if (!pvt.fix_ok() || pvt.position_invalid() || pvt.fix_type == 0 || pvt.fix_type >= time_only) return;
        if (!possible(pvt)) return sink.refuse(Refusal::out_of_range);
        sink.accept(time_of(pvt, frame), fix_of(pvt, tag_));
    }

    void give(const RelativePosition& relative, const Frame& frame, MeasurementSink& sink) {
        if (!tells_heading(relative)) return;
        const Heading heading = heading_of(relative, tag_);
        if (!possible(heading)) return sink.refuse(Refusal::out_of_range);
        sink.accept(time_of(relative, frame), heading);
    }

    void give(const RawEpoch& epoch, const Frame& frame, MeasurementSink& sink) {
        if (!possible(epoch)) return sink.refuse(Refusal::out_of_range);
        if (epoch.signals == 0) return;
        const Timestamp time = time_of(epoch, frame);
        for (std::size_t i = 0; i < epoch.signals; ++i) {
            const RawSignal signal = parse_raw_signal(payload_of(frame.bytes), i);
            if (!signal.pseudorange_valid()) continue;
            if (possible(signal))
                sink.accept(time, with_lock(raw_of(epoch, signal, tag_), signal));
            else
                sink.refuse(Refusal::out_of_range);
        }
    }

    GnssRaw with_lock(GnssRaw raw, const RawSignal& signal) {
        if (signal.carrier_valid() && !half_cycles_.settled(raw, signal.half_cycle_known())) raw.lock_s = 0;
        return raw;
    }

    void give(const Subframe& subframe, const Frame& frame, MeasurementSink& sink) const {
        if (subframe.word_count > GnssNavigation::max_words) return; // a kind that nothing here reads
        sink.accept(frame.begun, navigation_of(subframe, tag_));
    }

    void give(const SensorReport& report, const Frame& frame, MeasurementSink& sink) const {
        for (std::size_t i = 0; i < report.count(); ++i) {
            if (report.type(i) != SensorReport::speed) continue;
            WheelSpeed wheel;
            wheel.tag = tag_;
            wheel.speed_mps = report.value(i) * 1e-3;
            sink.accept(frame.begun, wheel);
        }
    }
};

} // namespace

std::unique_ptr<Decoder> make_ubx(const void* settings) {
    return std::make_unique<Ubx>(*static_cast<const UbxSettings*>(settings));
}

} // namespace locus::gnss
