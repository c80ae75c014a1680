// How high people are at each place of the image: from the calibration where there is one, else learnt from people who
// were seen alone. On a floor, seen by a camera that does not lean sideways much, the height in the image is a linear
// function of where the feet are (Hoiem, Efros, Hebert 2006, "Putting objects in perspective", eq. 5 with its horizon).
#pragma once

#include "drivers/camera/detector.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace locus::camera {

class HeightMap {
  public:
    explicit HeightMap(ExpectedHeight calibrated) : calibrated_{std::move(calibrated)} {}

    /// Somebody stands there, as far as can be told; some of them may be wrong.
    void learn(const vision::BoxPx& box);
    /// Empty: not known yet, or nobody can stand there.
    std::optional<float> at(float foot_x_px, float foot_y_px) const;
    bool is_known() const { return calibrated_ || plane_; }
    /// Another number: other heights.
    std::size_t revision() const { return fits_; }

  private:
    struct Sample {
        float x_px, y_px, height_px;
    };
    struct Plane {
        double at_origin_px, per_x, per_y;
        double at(double x_px, double y_px) const { return at_origin_px + per_x * x_px + per_y * y_px; }
    };
    float plane_height_px(const Plane& plane, float foot_x_px, float foot_y_px) const;
    void fit();
    Plane weighted_fit(const std::vector<double>& weights) const;
    double median_height_px() const;

    ExpectedHeight calibrated_;
    std::vector<Sample> samples_;
    std::size_t next_ = 0; ///< where the next sample goes, the oldest first once all places are taken
    std::optional<Plane> plane_;
    std::size_t fits_ = 0;
    float least_seen_px_ = 0;
    float most_seen_px_ = 0;
};

} // namespace locus::camera
