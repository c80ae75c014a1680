// Ranges and the path of a monocular SLAM (paper 001). Two of the default estimators hear all but the camera: one that
// knows nothing of it says roughly where the target was at each key frame; from there the similarity between the SLAM's
// path and the site is fitted to all ranges along the path (vision/scale/); the other takes the path as it lies by that
// fit, and is published. Nothing goes back from the second to the first, so the alignment never confirms itself. When
// the SLAM loses its way ranges alone carry the pose, and the next segment is aligned from nothing.
#pragma once

#include "fusion/estimators/inertial_ekf.h"
#include "fusion/estimators/visual_scale_settings.h"
#include "fusion/vision/scale/key_places.h"
#include "fusion/vision/scale/range_path.h"
#include "fusion/vision/scale/similarity_fit.h"

#include <optional>

namespace locus {

class VisualScale final : public Estimator {
  public:
    /// `site` outlives the estimator.
    VisualScale(const Site& site, const VisualScaleSettings& settings);

    /// All that inertial_ekf takes, and the odometry of the camera that the target wears.
    Verdict update(const Measurement& measurement) noexcept override;
    Estimate predict(Timestamp time) const noexcept override;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<VisualScale>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const VisualScale&>(other); }

    /// For tests: how the segment lies in the site, as far as that is known.
    const std::optional<vision::SimilarityFit>& fit() const noexcept { return fit_; }

  private:
    Verdict see(const VisualOdometry& odometry, const Measurement& measurement) noexcept;
    void begin_segment(const VisualOdometry& odometry) noexcept;
    void keep_place(Timestamp time) noexcept;
    void align() noexcept;
    const vision::SimilarityFit* aligned() const noexcept;
    AlignedPlace aligned_place(const vision::SimilarityFit& fit) noexcept;
    void renew_error(const Eigen::Vector3d& sigma_m) noexcept;
    void doubt(const Verdict& verdict) noexcept;
    void align_anew() noexcept;

    VisualScaleSettings settings_;
    InertialEkf heard_; ///< all but the camera
    InertialEkf fused_;
    RangeReader reader_;
    const Site* site_;
    vision::RangePath path_;
    vision::RangeRows rows_;
    vision::KeyPlaces places_; ///< for the start
    std::optional<vision::SimilarityFit> fit_;
    std::optional<Timestamp> kept_;
    bool has_begun_ = false;
    Address camera_ = no_address;
    std::uint32_t segment_ = 0;
    Eigen::Vector3d held_sigma_m_ = Eigen::Vector3d::Zero(); ///< of the alignment's error when it was last renewed
    std::uint32_t alignment_ = 0;
    int refused_in_a_row_ = 0;
};

std::unique_ptr<Estimator> make_visual_scale(const Site& site, const void* settings);

inline constexpr EstimatorRow visual_scale_row{
    "visual_scale", "Ranges and the path of a monocular SLAM, whose scale and place are found on the way (paper 001).",
    option_table<VisualScaleSettings>(visual_scale_options), make_visual_scale};

} // namespace locus
