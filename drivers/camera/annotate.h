// What an installer wants to see of a camera: the picture with the people in it, who they are, and the floor as the
// calibration has it.
#pragma once

#include "drivers/camera/picture.h"
#include "fusion/vision/camera_model.h"
#include "fusion/vision/tracker.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace locus::camera {

using TrackNames = std::map<std::uint32_t, std::string>; ///< of tracks whose owner is known

/// Draws into `picture`: a box for each track with its number and name, its foot, and a line of the floor each metre
/// of the site's axes. A grey picture becomes one in colour.
void annotate(Picture& picture, std::span<const vision::ImageTrack> tracks, const TrackNames& names,
              const std::optional<vision::FloorView>& floor);

/// Bytes of a JPEG file.
std::string to_jpeg(const Picture& picture);

/// Writes the bytes of a JPEG file as .png or as they are (.jpg, .jpeg). False, and a sentence in `error`, when it
/// cannot be.
bool write_picture(const std::string& path, const std::string& jpeg, std::string& error);

} // namespace locus::camera
