// From boxes without names to tracks (DeepSORT's scheme, after paper 000 section 3.1): a Kalman filter for each box,
// detections handed out by likelihood of motion and looks, then by overlap, then the detector's doubtful ones
// (ByteTrack). A track that nobody sees is lost, not gone, and is found again within a settable time.
#pragma once

#include "fusion/time.h"
#include "fusion/vision/camera_model.h"
#include "fusion/vision/detection.h"
#include "fusion/vision/track.h"
#include "fusion/vision/tracker_settings.h"

#include <optional>
#include <span>
#include <vector>

namespace locus::vision {

/// A person in the image, as far as the images up to now tell.
struct ImageTrack {
    std::uint32_t id = 0; ///< never given twice
    BoxPx box;
    Eigen::Vector2d foot_px;
    Eigen::Matrix2d foot_covariance_px2;
    Eigen::Vector2d head_px;
    Eigen::Matrix2d head_covariance_px2;
    float score = 0;       ///< of the last detection
    double age_s = 0;      ///< since the first
    double unseen_s = 0;   ///< since the last
    bool occluded = false; ///< somebody nearer covers him
    bool feet_seen = true; ///< in the last detection, as far as one can tell
    Looks looks{};         ///< in the last detection that showed all of him
};

/// Where on the floor he stands: by his feet or, where that is surer, by his head. Empty where neither sees the floor.
std::optional<FloorPoint> stands_at(const FloorView& floor, const ImageTrack& track, const BodyHeight& body) noexcept;

inline constexpr std::size_t max_detections = 256;

class Tracker {
  public:
    /// With `floor`, nobody is found again where he could not have walked. Tracks are numbered from `first_id` on.
    explicit Tracker(const TrackerSettings& settings, std::optional<FloorView> floor = std::nullopt,
                     std::uint32_t first_id = 1);

    /// The confirmed tracks after the image of `time`. Times rise; an image that is not newer than the last changes
    /// nothing. Boxes that are none (not finite, empty) are passed over, and all beyond max_detections.
    std::span<const ImageTrack> update(Timestamp time, std::span<const Detection> detections);

  private:
    void predict(double dt_s);
    void see(Track& track, const Detection& detection) const;
    void forget();
    void begin(const Detection& detection);
    void show();

    TrackerSettings settings_;
    std::optional<FloorView> floor_;
    std::vector<Track> tracks_;
    std::vector<ImageTrack> shown_;
    std::optional<Timestamp> last_;
    std::uint32_t next_id_;
};

} // namespace locus::vision
