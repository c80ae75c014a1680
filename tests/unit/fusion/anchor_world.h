// A hall whose anchors may be bad: tags that walk round in it, ranges or range differences with noise and with errors
// that hold for a while, anchors that stand elsewhere than the site says, paths that are too long. Through the engine.
#pragma once

#include "fusion/engine.h"
#include "fusion/estimators/range_ekf_settings.h"
#include "fusion/geometry/vector.h"

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace locus::test {

struct AnchorWorldSettings {
    std::size_t anchors = 8;
    int tags = 1;
    bool differences = false;
    double noise_m = 0.1;
    double held_m = 0.2, held_s = 0.3; ///< what the settings say, so that rates can be stated
    double sweep_s = 0.1;
    double common_m = 0.5; ///< what the settings say; there is none
    bool planar = false;
    unsigned seed = 1;
};

/// At most eight anchors: corners of 12 m x 10 m, high and low in turn.
inline Site anchored_hall(std::size_t anchors) {
    constexpr std::array<Vec3, 8> corners{
        {{0, 0, 3.2}, {12, 0, 0.4}, {12, 10, 3.2}, {0, 10, 0.4}, {6, 0, 0.6}, {12, 5, 3.4}, {6, 10, 0.5}, {0, 5, 3.0}}};
    Site site;
    for (std::size_t i = 0; i < anchors; ++i) site.anchors.push_back({"a" + std::to_string(i), address(i), corners[i]});
    return site;
}

class AnchorWorld {
  public:
    explicit AnchorWorld(const AnchorWorldSettings& settings)
        : settings_(settings), engine_(engine_settings(settings)), random_(settings.seed), stands_m_(settings.anchors),
          silent_(settings.anchors), heard_m_(settings.anchors),
          held_m_(settings.anchors * static_cast<std::size_t>(settings.tags)) {
        for (std::size_t i = 0; i < stands_m_.size(); ++i)
            stands_m_[i] = vector(engine_.settings().site.anchors[i].position_site_m);
        for (double& held_m : held_m_) held_m = settings.held_m * draw();
    }

    void move_anchor(std::size_t anchor, const Eigen::Vector3d& by_m) { stands_m_[anchor] += by_m; }
    void silence(std::size_t anchor, bool silent) { silent_[anchor] = silent; }
    /// By how much the range from this anchor to this tag is too long now.
    std::function<double(std::size_t anchor, int tag)> longer_m = [](std::size_t, int) { return 0.0; };

    /// One sweep of every tag over all anchors, then one tick.
    void sweep() {
        for (int tag = 0; tag < settings_.tags; ++tag) sweep(tag);
        time_s_ += settings_.sweep_s;
        engine_.step(timestamp_from_s(time_s_));
        ++sweeps_;
    }

    const AnchorReport& report(std::size_t anchor) const { return engine_.sources()[anchor].health; }
    AnchorState state(std::size_t anchor) const { return report(anchor).state; }
    Eigen::Vector3d stands_m(std::size_t anchor) const { return stands_m_[anchor]; }
    int sweeps() const { return sweeps_; }
    double time_s() const { return time_s_; }

  private:
    static EngineSettings engine_settings(const AnchorWorldSettings& settings) {
        EngineSettings engine;
        RangeEkfSettings filter;
        filter.planar = settings.planar;
        filter.height_m = 1.4;
        engine.fusion.estimator = "range_ekf";
        engine.estimators.push_back({find_estimator("range_ekf"), std::make_shared<const RangeEkfSettings>(filter)});
        engine.anchor_health.common_range_error_sigma_m = settings.common_m;
        engine.fusion.max_targets = settings.tags;
        engine.fusion.rate_hz = 1 / settings.sweep_s;
        engine.site = anchored_hall(settings.anchors);
        return engine;
    }

    double draw() { return normal_(random_); }

    /// A walk that comes everywhere: no two of its periods have a common multiple that matters.
    Eigen::Vector3d tag_m(int tag) const {
        const double t = time_s_ + 17.3 * tag;
        return {6 + 4.5 * std::sin(0.23 * t), 5 + 3.8 * std::sin(0.31 * t + 1),
                1.4 + (settings_.planar ? 0 : 0.5) * std::sin(0.17 * t + 2)};
    }

    void sweep(int tag) {
        const Eigen::Vector3d here_m = tag_m(tag);
        const double keep = std::exp(-settings_.sweep_s / settings_.held_s);
        for (std::size_t i = 0; i < settings_.anchors; ++i) {
            double& held_m = held_m_[static_cast<std::size_t>(tag) * settings_.anchors + i];
            held_m = keep * held_m + settings_.held_m * std::sqrt(1 - keep * keep) * draw();
            heard_m_[i] = (here_m - stands_m_[i]).norm() + held_m + longer_m(i, tag);
        }
        for (std::size_t i = 0; i < settings_.anchors; ++i) {
            const std::size_t next = (i + 1) % settings_.anchors;
            const double noise_m = settings_.noise_m * draw();
            if (silent_[i] || (settings_.differences && silent_[next])) continue;
            const Address whom = address(100 + static_cast<std::uint64_t>(tag));
            if (settings_.differences)
                submit(RangeDifference{address(i), address(next), whom,
                                       heard_m_[next] - heard_m_[i] + std::numbers::sqrt2 * noise_m});
            else
                submit(Range{address(i), whom, heard_m_[i] + noise_m});
        }
    }

    void submit(const Observation& observation) {
        const Timestamp now = timestamp_from_s(time_s_);
        engine_.submit({now, ++sequence_, 0, observation}, now);
    }

    AnchorWorldSettings settings_;
    Engine engine_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::vector<Eigen::Vector3d> stands_m_;
    std::vector<bool> silent_;
    std::vector<double> heard_m_; ///< now
    std::vector<double> held_m_;  ///< tags times anchors
    double time_s_ = 1;
    std::uint32_t sequence_ = 0;
    int sweeps_ = 0;
};

} // namespace locus::test
