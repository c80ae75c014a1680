// WornCamera: what the frames of a camera that somebody wears become: its way, by visual odometry. The lens is read
// when the first frame is there, and again when the frames change their size; as long as it is missing or wrong it says
// so, tries again every few seconds, and the daemon goes on without.
#pragma once

#include "config/camera_input.h"
#include "drivers/camera/picture.h"

#include <optional>
#include <string>

namespace locus {

class WornCamera {
  public:
    explicit WornCamera(CameraInputSettings settings) : settings_{std::move(settings)} {}

    /// Of the wearer's tag, as camera number `camera`; empty while the frame tells no place.
    std::optional<VisualOdometry> look(const camera::Frame& frame, Address camera);

    /// What stands in the way, or that the way is lost; in a sentence, empty when all is well.
    const std::string& trouble() const { return trouble_; }
    /// Whether it starts, tracks or is lost, for people.
    const std::string& doing() const { return doing_; }

  private:
    void prepare_if_due(const camera::Picture& picture);
    void prepare(const camera::Picture& picture);
    void tell(const camera::OdometerReading& reading);

    CameraInputSettings settings_;
    std::optional<camera::VisualOdometer> odometer_;
    std::string trouble_, doing_;
    int width_px_ = 0, height_px_ = 0; ///< of the frames it is ready for, or was last tried for
    Timestamp tried_{};
};

} // namespace locus
