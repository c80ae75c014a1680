// Onlooker: what a camera's frames become, by its settings. What it needs besides the frames (calibration, a network's
// weights) is read when the first frame is there, and again when the frames change their size; as long as something is
// missing or wrong it says so, tries again every few seconds, and the daemon goes on without this camera's people.
#pragma once

#include "config/camera_input.h"
#include "drivers/camera/people.h"

#include <optional>
#include <string>

namespace locus {

class Onlooker {
  public:
    explicit Onlooker(CameraInputSettings settings) : settings_{std::move(settings)} {}

    /// The tracks after this frame; none while there is a trouble that keeps it from seeing.
    std::span<const vision::ImageTrack> look(const camera::Frame& frame);
    /// On the floor, in the last frame.
    std::span<const FootPoint> feet(Address camera);

    /// In a sentence; empty when all is well.
    const std::string& trouble() const { return trouble_; }
    /// For frames of this size; empty without a calibration.
    const std::optional<vision::FloorView>& floor() const { return floor_; }

  private:
    void prepare_if_due(const camera::Picture& picture);
    void prepare(const camera::Picture& picture);
    void read_calibration(const camera::Picture& picture);

    CameraInputSettings settings_;
    std::optional<camera::People> people_;
    std::optional<vision::FloorView> floor_;
    std::string trouble_;
    int width_px_ = 0, height_px_ = 0; ///< of the frames it is ready for, or was last tried for
    Timestamp tried_{};
};

} // namespace locus
