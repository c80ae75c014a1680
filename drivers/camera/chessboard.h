// A chessboard in a picture: the corners where four of its squares meet, as OpenCV finds them.
#pragma once

#include "drivers/camera/picture.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace locus::camera {

/// Inner corners, not squares: a board of 10 x 7 squares has 9 x 6.
struct BoardShape {
    int columns = 9;
    int rows = 6;
    double square_m = 0.03;
};

using BoardCorners = std::vector<Eigen::Vector2d>;

/// Row by row, px from the corner of the upper left pixel; empty where the board is not seen whole. Three channels.
std::optional<BoardCorners> find_chessboard(const Picture& picture, const BoardShape& shape);

} // namespace locus::camera
