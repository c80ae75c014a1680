#include "drivers/camera/height_map.h"

#include "drivers/camera/person_shape.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace locus::camera {
namespace {

constexpr std::size_t least_samples = 60; // twenty for each of the three numbers; one person gives one a frame
constexpr std::size_t most_samples = 500;
constexpr std::size_t fit_every = 10;
constexpr float least_possible_px = 8;
constexpr double slope_sigma = 1;          // px of height per px of place, before anything was seen
constexpr double relative_sigma = 0.1;     // of people's heights and of boxes around them
constexpr double tukey_tuning = 4.685;     // 95 % efficiency with normal errors (Huber and Ronchetti 2009)
constexpr double sigma_of_median = 1.4826; // of absolute deviations, with normal errors

double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double tukey_weight(double residual, double sigma) {
    const double scaled = residual / (tukey_tuning * sigma);
    return std::abs(scaled) < 1 ? (1 - scaled * scaled) * (1 - scaled * scaled) : 0;
}

} // namespace

void HeightMap::learn(const vision::BoxPx& box) {
    if (calibrated_) return;
    const Sample sample{foot_x_px(box), box.bottom_px(), box.height_px};
    if (samples_.size() < most_samples)
        samples_.push_back(sample);
    else
        samples_[next_] = sample;
    next_ = (next_ + 1) % most_samples;
    if (samples_.size() >= least_samples && next_ % fit_every == 0) fit();
}

std::optional<float> HeightMap::at(float foot_x_px, float foot_y_px) const {
    float height_px = 0;
    if (calibrated_)
        height_px = calibrated_(foot_x_px, foot_y_px);
    else if (plane_)
        height_px = static_cast<float>(plane_->at(foot_x_px, foot_y_px));
    if (!(height_px >= least_possible_px)) return std::nullopt;
    return height_px;
}

/// A plane says little of places that are much nearer or farther than where anybody was seen.
float HeightMap::plane_height_px(const Plane& plane, float foot_x_px, float foot_y_px) const {
    const auto height_px = static_cast<float>(plane.at(foot_x_px, foot_y_px));
    return height_px >= least_of_expected * least_seen_px_ && height_px <= most_of_expected * most_seen_px_ ? height_px
                                                                                                            : 0;
}

/// Iteratively reweighted, from the median height everywhere: groups and halves of people are outliers.
void HeightMap::fit() {
    Plane plane = plane_.value_or(Plane{median_height_px(), 0, 0});
    std::vector<double> residuals(samples_.size());
    std::vector<double> weights(samples_.size());
    for (int iteration = 0; iteration < 10; ++iteration) {
        for (std::size_t i = 0; i < samples_.size(); ++i)
            residuals[i] = samples_[i].height_px - plane.at(samples_[i].x_px, samples_[i].y_px);
        std::vector<double> sizes(residuals);
        for (double& size : sizes) size = std::abs(size);
        const double sigma = std::max(sigma_of_median * middle_of(std::move(sizes)), 1.);
        for (std::size_t i = 0; i < samples_.size(); ++i) weights[i] = tukey_weight(residuals[i], sigma);
        plane = weighted_fit(weights);
    }
    plane_ = plane;
    ++fits_;
    least_seen_px_ = most_seen_px_ = static_cast<float>(median_height_px());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (weights[i] < 0.5) continue;
        least_seen_px_ = std::min(least_seen_px_, samples_[i].height_px);
        most_seen_px_ = std::max(most_seen_px_, samples_[i].height_px);
    }
}

HeightMap::Plane HeightMap::weighted_fit(const std::vector<double>& weights) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Eigen::Vector3d row{1, samples_[i].x_px, samples_[i].y_px};
        normal += weights[i] * row * row.transpose();
        right += weights[i] * samples_[i].height_px * row;
    }
    const double prior = std::pow(relative_sigma * median_height_px() / slope_sigma, 2);
    normal.diagonal() += Eigen::Vector3d{1e-9, prior, prior};
    const Eigen::Vector3d solution = normal.ldlt().solve(right);
    return {solution[0], solution[1], solution[2]};
}

double HeightMap::median_height_px() const {
    std::vector<double> heights;
    heights.reserve(samples_.size());
    for (const Sample& sample : samples_) heights.push_back(sample.height_px);
    return middle_of(std::move(heights));
}

} // namespace locus::camera
