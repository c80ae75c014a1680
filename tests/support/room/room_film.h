// What a worn camera makes of a walk through a room: the scene as it moves past during the exposure, and noise.
#pragma once

#include "tests/support/room/room_walk.h"

#include "drivers/camera/picture.h"

namespace locus::room {

struct FilmSettings {
    double rate_hz = 15;
    double exposure_s = 0.008; ///< under lamps
    double noise = 3;          ///< of 255, one sigma
};

class RoomFilm {
  public:
    RoomFilm(const RoomScene& scene, const RoomWalk& walk, unsigned seed, const FilmSettings& settings = {})
        : scene_{scene}, walk_{walk}, settings_{settings}, random_{seed + 1} {}

    /// Grey, taken at that moment of the walk.
    camera::Picture at(double time_s);
    /// As a hand before the lens: dark, and noise.
    camera::Picture covered();

  private:
    camera::Picture with_noise(const cv::Mat& clean);

    const RoomScene& scene_;
    const RoomWalk& walk_;
    FilmSettings settings_;
    cv::RNG random_;
};

} // namespace locus::room
