#include "drivers/camera/odometry/two_view_models.h"

#include "drivers/camera/odometry/triangulate.h"

#include <opencv2/calib3d.hpp>

namespace locus::camera {
namespace {

constexpr double certainty = 0.999;
constexpr int most_draws = 1000;

Eigen::Matrix3d as_eigen(const cv::Mat& m) {
    Eigen::Matrix3d out;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) out(row, column) = m.at<double>(row, column);
    return out;
}

CameraPose as_pose(const cv::Mat& rotation, const cv::Mat& way) {
    const Eigen::Vector3d shift(way.at<double>(0), way.at<double>(1), way.at<double>(2));
    return {Eigen::Quaterniond(as_eigen(rotation)).normalized(), shift.normalized()};
}

/// Eq. 2: what a match adds, from its squared distance in sigmas; both models count from the same level.
double worth(double squared, double limit) { return squared < limit ? most_off_point - squared : 0; }

double off_line(const Eigen::Vector3d& line, const Eigen::Vector3d& point, double sigma) {
    const double distance = line.dot(point) / (line.head<2>().norm() * sigma);
    return distance * distance;
}

double off_point(const Eigen::Vector3d& there, const Eigen::Vector3d& point, double sigma) {
    return (there.hnormalized() - point.head<2>()).squaredNorm() / (sigma * sigma);
}

template <class OneWay>
double score_of(const std::vector<cv::Point2d>& first, const std::vector<cv::Point2d>& second, double limit,
                const OneWay& squared) {
    double score = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const Eigen::Vector3d a(first[i].x, first[i].y, 1), b(second[i].x, second[i].y, 1);
        const auto [there, back] = squared(a, b);
        score += worth(there, limit) + worth(back, limit);
    }
    return score;
}

} // namespace

TwoViewModel essential_model(const std::vector<cv::Point2d>& first, const std::vector<cv::Point2d>& second,
                             double sigma) {
    const cv::Mat unit = cv::Mat::eye(3, 3, CV_64F);
    const cv::Mat found =
        cv::findEssentialMat(first, second, unit, cv::RANSAC, certainty, std::sqrt(most_off_line) * sigma);
    if (found.rows != 3) return {};
    cv::Mat turn_a, turn_b, way;
    cv::decomposeEssentialMat(found, turn_a, turn_b, way);
    const Eigen::Matrix3d essential = as_eigen(found);
    TwoViewModel model;
    model.score = score_of(first, second, most_off_line, [&](const auto& a, const auto& b) {
        return std::pair(off_line(essential * a, b, sigma), off_line(essential.transpose() * b, a, sigma));
    });
    for (const cv::Mat& turn : {turn_a, turn_b})
        for (const double side : {1., -1.}) model.motions.push_back(as_pose(turn, side * way));
    return model;
}

TwoViewModel homography_model(const std::vector<cv::Point2d>& first, const std::vector<cv::Point2d>& second,
                              double sigma) {
    const cv::Mat found = cv::findHomography(first, second, cv::RANSAC, std::sqrt(most_off_point) * sigma,
                                             cv::noArray(), most_draws, certainty);
    if (found.empty() || !(std::abs(cv::determinant(found)) > 1e-9)) return {};
    std::vector<cv::Mat> turns, ways, normals;
    cv::decomposeHomographyMat(found, cv::Mat::eye(3, 3, CV_64F), turns, ways, normals);
    const Eigen::Matrix3d there = as_eigen(found), back = there.inverse();
    TwoViewModel model;
    model.score = score_of(first, second, most_off_point, [&](const auto& a, const auto& b) {
        return std::pair(off_point(there * a, b, sigma), off_point(back * b, a, sigma));
    });
    for (std::size_t i = 0; i < turns.size(); ++i)
        if (cv::norm(ways[i]) > 0) model.motions.push_back(as_pose(turns[i], ways[i]));
    return model;
}

} // namespace locus::camera
