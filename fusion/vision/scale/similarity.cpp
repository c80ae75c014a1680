#include "fusion/vision/scale/similarity.h"

#include "fusion/geometry/rotation.h"

namespace locus::vision {

Eigen::Vector3d Similarity::place_site_m(const Eigen::Vector3d& position_odometry,
                                         const Eigen::Vector3d& velocity_odometry_per_s) const {
    const Eigen::Vector3d from_centre = position_odometry - centre_odometry;
    return origin_site_m + turned_m(from_centre + offset_s * velocity_odometry_per_s);
}

Similarity::Jacobian Similarity::jacobian(const Eigen::Vector3d& position_odometry,
                                          const Eigen::Vector3d& velocity_odometry_per_s) const {
    const Eigen::Vector3d arm_m = place_site_m(position_odometry, velocity_odometry_per_s) - origin_site_m;
    Jacobian all;
    all.col(log_scale_at) = arm_m;
    all.middleCols<3>(turn_at) = -skew(arm_m);
    all.middleCols<3>(origin_at).setIdentity();
    all.col(offset_at) = turned_m(velocity_odometry_per_s);
    return all;
}

void Similarity::move_by(const Vector& step) {
    log_scale += step(log_scale_at);
    const Eigen::Vector3d turn_rad = step.segment<3>(turn_at);
    site_from_odometry = (rotation(turn_rad) * site_from_odometry).normalized();
    origin_site_m += step.segment<3>(origin_at);
    offset_s += step(offset_at);
}

} // namespace locus::vision
