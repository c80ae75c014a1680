// A person on a walk past anchors, and what the radio makes of it: the scene of the papers' experiments. Each arrival
// has noise that is new every time, an error of its anchor that stays for a while (Gauss-Markov), and what is added
// where the straight path is blocked. The figures are the defaults of the settings: what DW1000 kits showed
// (fusion/estimators/range_ekf_settings.h), not chosen for any experiment.
#pragma once

#include "fusion/estimators/range_ekf_settings.h"
#include "fusion/filter/motion.h"
#include "fusion/geometry/vector.h"
#include "fusion/measurement.h"
#include "fusion/site.h"

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace locus::papers {

constexpr double walking_mps = 1.2;
constexpr double tag_height_m = 1.2;

using Way = std::vector<Eigen::Vector2d>;

/// Along the corners of a way and again from its first, at walking speed.
class Walker {
  public:
    explicit Walker(Way corners) : corners_(std::move(corners)) {
        for (std::size_t i = 0; i < corners_.size(); ++i) length_m_ += leg(i).norm();
    }

    Eigen::Vector3d position_m(double time_s) const {
        double gone_m = std::fmod(walking_mps * time_s, length_m_);
        std::size_t i = 0;
        for (; gone_m > leg(i).norm(); i = (i + 1) % corners_.size()) gone_m -= leg(i).norm();
        const Eigen::Vector2d place = corners_[i] + gone_m * leg(i).normalized();
        return {place.x(), place.y(), tag_height_m};
    }
    Eigen::Vector3d direction(double time_s) const {
        return (position_m(time_s + 0.01) - position_m(time_s)).normalized();
    }

  private:
    Eigen::Vector2d leg(std::size_t i) const { return corners_[(i + 1) % corners_.size()] - corners_[i]; }

    Way corners_;
    double length_m_ = 0;
};

struct Noise {
    double fresh_m = RangeEkfSettings{}.range_sigma_m;
    double held_m = RangeEkfSettings{}.anchor_error_sigma_m;
    double held_s = RangeEkfSettings{}.anchor_error_time_s;
};

/// Of a path through a chair or a body: the lower end of what issue 4 calls blocked (0.3 to 1.5 m).
constexpr double blocked_longer_m = 0.3;

/// What a blocked path adds to the distance, m; 0 where it is free.
using Blocked = std::function<double(const Eigen::Vector3d& tag_m, const Eigen::Vector3d& anchor_m, double time_s)>;

class Radio {
  public:
    Radio(const Site& site, const Noise& noise, unsigned seed) : site_(site), noise_(noise), random_(seed) {
        for (std::size_t i = 0; i < site.anchors.size(); ++i) held_m_.push_back(noise.held_m * draw());
    }

    /// Distance to every anchor as measured at one moment.
    std::vector<double> hear(const Eigen::Vector3d& tag_m, double time_s, const Blocked& blocked = {}) {
        const auto wander = filter::wander_step(noise_.held_m, noise_.held_s, time_s - time_s_);
        time_s_ = time_s;
        std::vector<double> distances_m;
        for (std::size_t i = 0; i < held_m_.size(); ++i) {
            held_m_[i] = wander.keep * held_m_[i] + std::sqrt(wander.variance) * draw();
            const Eigen::Vector3d anchor_m = vector(site_.anchors[i].position_site_m);
            const double longer_m = blocked ? blocked(tag_m, anchor_m, time_s) : 0;
            distances_m.push_back((tag_m - anchor_m).norm() + held_m_[i] + noise_.fresh_m * draw() + longer_m);
        }
        return distances_m;
    }

  private:
    double draw() { return normal_(random_); }

    const Site& site_;
    Noise noise_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::vector<double> held_m_;
    double time_s_ = 0;
};

inline constexpr Address tag_address = address(99);

/// As ranges, or as differences of arrivals against the first anchor.
inline std::vector<Measurement> ranges(const Site& site, const std::vector<double>& distances_m, double time_s) {
    std::vector<Measurement> all;
    for (std::size_t i = 0; i < distances_m.size(); ++i)
        all.push_back({timestamp_from_s(time_s), 0, 0, Range{site.anchors[i].address, tag_address, distances_m[i]}});
    return all;
}
inline std::vector<Measurement> differences(const Site& site, const std::vector<double>& distances_m, double time_s) {
    std::vector<Measurement> all;
    for (std::size_t i = 1; i < distances_m.size(); ++i)
        all.push_back({timestamp_from_s(time_s), 0, 0,
                       RangeDifference{site.anchors[0].address, site.anchors[i].address, tag_address,
                                       distances_m[i] - distances_m[0]}});
    return all;
}

inline Site site_of(const std::vector<Vec3>& anchors) {
    Site site;
    for (const Vec3& place : anchors) site.anchors.push_back({"", address(site.anchors.size()), place});
    return site;
}

} // namespace locus::papers
