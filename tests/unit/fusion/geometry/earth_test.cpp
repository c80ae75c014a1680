// Earth: places there and back, the site's axes, and gravity as the textbooks have it.
#include "fusion/geometry/earth.h"

#include <gtest/gtest.h>

namespace locus {
namespace {

TEST(Earth, PlacesThereAndBack) {
    const Geodetic tokyo{35.66, 139.79, 40};
    const Geodetic back = geodetic(ecef_m(tokyo));
    EXPECT_NEAR(back.latitude_deg, tokyo.latitude_deg, 1e-12);
    EXPECT_NEAR(back.longitude_deg, tokyo.longitude_deg, 1e-12);
    EXPECT_NEAR(back.height_ellipsoid_m, tokyo.height_ellipsoid_m, 1e-8);
    EXPECT_NEAR(ecef_m({0, 90, 0}).y(), 6378137, 1e-6);
    EXPECT_NEAR(ecef_m({90, 0, 0}).z(), 6356752.314245, 1e-6);
}

TEST(Earth, AxesOfASite) {
    const SiteOnEarth to_the_north({45, 10, 100, 0}); // x axis points north, so y points west
    const Eigen::Vector3d place_site_m(2000, -300, 15);
    const Eigen::Vector3d place_ecef_m = to_the_north.ecef_m(place_site_m);
    EXPECT_LT((to_the_north.site_m(place_ecef_m) - place_site_m).norm(), 1e-8);
    const Eigen::Vector3d enu_m = enu_to_ecef({45, 10, 100}).transpose() * (place_ecef_m - ecef_m({45, 10, 100}));
    EXPECT_LT((enu_m - Eigen::Vector3d(300, 2000, 15)).norm(), 1e-8);
}

/// Somigliana at the pole and the equator: 9.8321849378 and 9.7803253359 m/s^2.
TEST(Earth, GravityOfTheEllipsoid) {
    EXPECT_NEAR(gravity_ecef_mps2(ecef_m({90, 0, 0})).z(), -9.8321849378, 1e-7);
    EXPECT_NEAR(gravity_ecef_mps2(ecef_m({0, 0, 0})).x(), -9.7803253359, 1e-7);
    EXPECT_NEAR(gravity_ecef_mps2(ecef_m({45, 0, 1000})).norm(), 9.806199203 - 3.086e-3, 1e-5);
}

} // namespace
} // namespace locus
