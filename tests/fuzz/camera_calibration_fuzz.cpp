// Any bytes as a camera's calibration: a view or problems, never both, and a view answers every pixel with numbers or
// not.
#include "config/camera_calibration.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    locus::config::Problems problems("fuzz");
    const auto calibration = locus::config::parse_camera({reinterpret_cast<const char*>(data), size}, problems);
    if (calibration.has_value() != problems.empty()) std::abort();
    if (!calibration) return 0;
    for (const double share : {0.0, 0.3, 0.5, 1.0}) {
        const Eigen::Vector2d pixel = share * calibration->image_px;
        const auto foot = locus::vision::foot_on_floor(calibration->view, {pixel, Eigen::Matrix2d::Identity()});
        if (foot && !(foot->position_site_m.allFinite() && foot->covariance_m2.allFinite())) std::abort();
    }
    return 0;
}
