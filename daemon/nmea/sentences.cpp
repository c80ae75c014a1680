#include "daemon/nmea/sentences.h"

#include "drivers/gnss/nmea_messages.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

namespace locus {
namespace {

using namespace gnss::nmea;

constexpr double knots_per_mps = 3600.0 / 1852;
constexpr double least_course_mps = 0.05; ///< slower than this there is no course to tell

std::int64_t time_of_day_us(const UtcTime& time) {
    constexpr std::int64_t day_us = 86'400'000'000;
    return time.unix_us % day_us + (time.leap_second ? 1'000'000 : 0);
}

unsigned date_ddmmyy(const UtcTime& time) {
    const std::time_t seconds = time.unix_us / 1'000'000;
    std::tm parts{};
    ::gmtime_r(&seconds, &parts);
    return static_cast<unsigned>(parts.tm_mday * 10000 + (parts.tm_mon + 1) * 100 + parts.tm_year % 100);
}

/// GGA's quality and the mode of RMC and VTG.
unsigned quality_of(PoseValidity validity) { return validity == PoseValidity::measured ? 1 : 6; }
char mode_of(PoseValidity validity) { return validity == PoseValidity::measured ? 'A' : 'E'; }

double clockwise_from_north_deg(const Eigen::Vector3d& enu) {
    const double turned = std::atan2(enu.x(), enu.y()) * 180 / std::numbers::pi;
    return turned < 0 ? turned + 360 : turned;
}

/// A pose in the axes of its place: east, north, up.
class PoseOnEarth {
  public:
    PoseOnEarth(const SiteOnEarth& earth, const Estimate& estimate)
        : place_(geodetic(earth.ecef_m(vector(estimate.position_site_m)))),
          site_to_enu_(enu_to_ecef(place_).transpose() * earth.to_ecef()), estimate_(estimate),
          velocity_mps_(site_to_enu_ * vector(estimate.velocity_site_mps)) {}

    const Geodetic& place() const { return place_; }
    double speed_knots() const { return velocity_mps_.head<2>().norm() * knots_per_mps; }
    double course_deg() const {
        return velocity_mps_.head<2>().norm() < least_course_mps ? not_told : clockwise_from_north_deg(velocity_mps_);
    }
    /// Of the body's x axis; not told when the attitude is not known.
    double heading_deg() const {
        const auto& [x, y, z, w] = estimate_.orientation_xyzw;
        const Eigen::Quaterniond body_to_site(w, x, y, z);
        if (body_to_site.norm() == 0) return not_told;
        return clockwise_from_north_deg(site_to_enu_ * (body_to_site * Eigen::Vector3d::UnitX()));
    }
    Eigen::Vector3d sigma_m() const {
        const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> all(estimate_.covariance.data());
        const Eigen::Matrix3d covariance = site_to_enu_ * all.topLeftCorner<3, 3>() * site_to_enu_.transpose();
        return covariance.diagonal().cwiseMax(0).cwiseSqrt();
    }

  private:
    Geodetic place_;
    Eigen::Matrix3d site_to_enu_;
    const Estimate& estimate_;
    Eigen::Vector3d velocity_mps_;
};

std::string nothing_known(const UtcTime& time) {
    Gga gga;
    Rmc rmc;
    gga.time_us = rmc.time_us = time_of_day_us(time);
    rmc.date_ddmmyy = date_ddmmyy(time);
    return encode(gga) + encode(rmc) + encode(Vtg{not_told, not_told, 'N'});
}

std::string known(const NmeaOutputSettings& settings, const PoseOnEarth& pose, PoseValidity validity,
                  const UtcTime& time) {
    const auto& [latitude_deg, longitude_deg, height_m] = pose.place();
    const Eigen::Vector3d sigma_m = pose.sigma_m();
    const char mode = mode_of(validity);
    const std::int64_t now_us = time_of_day_us(time);
    const Gga gga{now_us,
                  latitude_deg,
                  longitude_deg,
                  quality_of(validity),
                  0,
                  not_told,
                  height_m - settings.geoid_height_m,
                  settings.geoid_height_m};
    const Rmc rmc{now_us, true, latitude_deg, longitude_deg, pose.speed_knots(), pose.course_deg(), date_ddmmyy(time),
                  mode};
    std::string lines = encode(gga) + encode(rmc) + encode(Vtg{pose.course_deg(), pose.speed_knots(), mode}) +
                        encode(Gst{now_us, sigma_m.y(), sigma_m.x(), sigma_m.z()});
    if (std::isfinite(pose.heading_deg())) lines += encode(Hdt{pose.heading_deg()});
    return lines;
}

template <class Sample>
constexpr std::uint32_t kind_bit() {
    return 1U << Observation{Sample{}}.index();
}

} // namespace

PoseValidity validity_of(const Pose& pose, double worst_error_m) {
    constexpr std::uint32_t own_senses = kind_bit<ImuSample>() | kind_bit<WheelSpeed>() | kind_bit<Pressure>() |
                                         kind_bit<Height>() | kind_bit<VisualOdometry>();
    const auto bound_m = double{pose.horizontal_error_95_m};
    if (pose.estimate.missing != Missing::nothing || !(bound_m <= worst_error_m)) return PoseValidity::none;
    return (pose.estimate.kinds_used & ~own_senses) != 0 ? PoseValidity::measured : PoseValidity::estimated;
}

std::string nmea_sentences(const NmeaOutputSettings& settings, const SiteOnEarth& earth, const Pose* pose,
                           const UtcTime& time) {
    const PoseValidity validity = pose != nullptr ? validity_of(*pose, settings.worst_error_m) : PoseValidity::none;
    if (validity == PoseValidity::none) return nothing_known(time);
    return known(settings, PoseOnEarth(earth, pose->estimate), validity, time);
}

} // namespace locus
