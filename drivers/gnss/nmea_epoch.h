// The sentences of one moment, and the fix that they make together.
#pragma once

#include "drivers/gnss/nmea_messages.h"

namespace locus::gnss::nmea {

class Epoch {
  public:
    /// Kinds of sentence, as bits.
    enum Kind : unsigned { position = 1, velocity = 2, spread = 4 };

    Epoch() = default;
    Epoch(std::int64_t time_us, Timestamp begun) : time_us_{time_us}, begun_{begun} {}

    std::int64_t time_us() const { return time_us_; }
    Timestamp begun() const { return begun_; }
    unsigned kinds() const { return kinds_; }

    void add(const Gga& gga) { gga_ = gga, kinds_ |= position; }
    void add(const Rmc& rmc);
    void add(const Vtg& vtg);
    void add(const Gst& gst) { gst_ = gst, kinds_ |= spread; }
    void add(const Zda& /*zda*/) {}

    /// Empty when the receiver has no fix, or no height.
    std::optional<GnssFix> fix(Address tag, double range_error_m) const;

  private:
    void set_velocity(double speed_knots, double course_deg);

    std::int64_t time_us_ = no_time;
    Timestamp begun_{};
    unsigned kinds_ = 0;
    bool rmc_came_ = false;
    Gga gga_;
    Gst gst_;
    Vec3f velocity_enu_mps_ = unknown_vec3f;
};

} // namespace locus::gnss::nmea
