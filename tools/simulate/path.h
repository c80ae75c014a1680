// A closed curve walked round at constant speed, known by its length: where the targets of a scenario go.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace locus::simulate {

class Path {
  public:
    /// Through these points and back to the first; one point stands still. Straight lines, corners rounded over at
    /// most `corner_m` of either side.
    static Path through(const std::vector<Eigen::Vector3d>& points, double corner_m);

    /// A lying eight round `centre`, `size_m` from end to end in x, y and z.
    static Path figure_of_eight(const Eigen::Vector3d& centre, const Eigen::Vector3d& size_m);

    double length_m() const { return at_m_.back(); }

    struct Point {
        Eigen::Vector3d position;
        Eigen::Vector3d direction; ///< unit length; zero when standing still
    };
    /// After `distance_m` from the beginning; goes on round and round.
    Point at(double distance_m) const;

  private:
    explicit Path(std::vector<Eigen::Vector3d> points);

    std::vector<Eigen::Vector3d> points_; ///< the last is the first again
    std::vector<double> at_m_;            ///< distance from the first point to each
};

} // namespace locus::simulate
