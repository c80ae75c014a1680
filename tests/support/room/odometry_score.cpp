#include "tests/support/room/odometry_score.h"

namespace locus::room {

OdometryScore score_odometry(const std::vector<PathPair>& path, double way_m) {
    OdometryScore score;
    const auto count = static_cast<Eigen::Index>(path.size());
    Eigen::Matrix3Xd truth(3, count), told(3, count);
    std::vector<double> gone_m(path.size(), 0);
    for (std::size_t i = 0; i < path.size(); ++i) {
        truth.col(static_cast<Eigen::Index>(i)) = path[i].truth_m;
        told.col(static_cast<Eigen::Index>(i)) = path[i].told;
        if (i > 0) gone_m[i] = gone_m[i - 1] + (path[i].truth_m - path[i - 1].truth_m).norm();
    }
    if (path.size() < 3) return score;
    const Eigen::Matrix4d similarity = Eigen::umeyama(told, truth, true);
    const Eigen::Matrix3Xd placed =
        (similarity.topLeftCorner<3, 3>() * told).colwise() + Eigen::Vector3d(similarity.topRightCorner<3, 1>());
    score.length_m = gone_m.back();
    score.rmse_m = std::sqrt((placed - truth).colwise().squaredNorm().mean());
    score.metres_a_unit = similarity.topLeftCorner<3, 1>().norm();
    std::size_t end = 0, ways = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        while (end < path.size() && gone_m[end] - gone_m[i] < way_m) ++end;
        if (end == path.size()) break;
        const Eigen::Vector3d truth_way = path[i].truth_turn.conjugate() * (path[end].truth_m - path[i].truth_m);
        const Eigen::Vector3d told_way = path[i].told_turn.conjugate() * (path[end].told - path[i].told);
        score.relative += (score.metres_a_unit * told_way - truth_way).norm() / (gone_m[end] - gone_m[i]);
        ++ways;
    }
    if (ways > 0) score.relative /= static_cast<double>(ways);
    return score;
}

} // namespace locus::room
