// Viewfinder: the publisher asks a camera's thread for a picture, and gets the next one with what is seen in it drawn
// in. As long as nobody asks, nothing is drawn, kept or copied.
#pragma once

#include "drivers/camera/annotate.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace locus {

class Viewfinder {
  public:
    /// Publisher: the next picture is wanted, with these names in it.
    void ask(camera::TrackNames names);
    /// Publisher: bytes of the JPEG file that was asked for; null: not there yet.
    std::shared_ptr<const std::string> picture() const;

    /// Camera's thread: the names to draw, when somebody has asked.
    std::optional<camera::TrackNames> asked() const;
    /// Camera's thread: what was asked for.
    void show(std::string jpeg);

  private:
    mutable std::mutex mutex_;
    std::optional<camera::TrackNames> names_; ///< set: asked, not shown yet
    std::shared_ptr<const std::string> picture_;
};

} // namespace locus
