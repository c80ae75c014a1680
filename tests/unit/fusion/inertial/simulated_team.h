// Three people with worn units, a metre apart, who go where they are led; ranges to anchors and to each other, into one
// engine. Everything is drawn from a seed.
#pragma once

#include "fusion/engine.h"
#include "tests/unit/fusion/inertial/simulated_walker.h"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace locus::test {

constexpr std::size_t team_size = 3;
inline Address member(std::size_t i) { return address(100 + i); }

struct TeamModel {
    WalkerModel walker;
    double range_sigma_m = 0.1;
    double range_period_s = 0.2;
    bool units = true;
    bool peers = true;
};

/// Excess of the path from an anchor to a member, m; NaN: not heard.
using Excess = std::function<double(std::size_t anchor, std::size_t member)>;

class SimulatedTeam {
  public:
    SimulatedTeam(EngineSettings settings, const TeamModel& model, unsigned seed,
                  const std::array<Eigen::Vector2d, team_size>& at, double heading_rad)
        : model_(model), engine_(std::make_unique<Engine>(settings)), anchors_(settings.site.anchors), random_(seed) {
        for (std::size_t i = 0; i < team_size; ++i) {
            WalkerModel each = model.walker;
            walkers_.emplace_back(each, 1000 * seed + static_cast<unsigned>(i));
            walkers_.back().place(at[i], heading_rad);
        }
    }

    /// One sample of each unit, with all that is heard then; turn of each, rad/s.
    void move(const std::array<double, team_size>& turn_radps, bool walking, const Excess& excess) {
        ++samples_;
        for (std::size_t i = 0; i < team_size; ++i) {
            const ImuSample sample = walkers_[i].move(turn_radps[i], walking);
            if (model_.units) submit(named(sample, i));
        }
        const auto period = static_cast<int>(std::lround(model_.range_period_s * model_.walker.rate_hz));
        if (samples_ % period == 0) hear_all(excess);
        poses_ = engine_->step(walkers_[0].time());
    }

    double time_s() const { return walkers_[0].time_s(); }
    const SimulatedWalker& walker(std::size_t i) const { return walkers_[i]; }
    SimulatedWalker& walker(std::size_t i) { return walkers_[i]; }
    const EngineCounters& counters() const { return engine_->counters(); }

    /// nullptr: no pose.
    const Estimate* estimate(std::size_t i) const {
        for (const Pose& pose : poses_)
            if (pose.target == member(i) && pose.estimate.missing == Missing::nothing) return &pose.estimate;
        return nullptr;
    }
    Eigen::Vector2d error_m(std::size_t i) const {
        const Estimate* found = estimate(i);
        if (found == nullptr) return {100, 100};
        return Eigen::Vector2d(found->position_site_m[0], found->position_site_m[1]) - walkers_[i].position_m();
    }
    double squared_in_sigma(std::size_t i) const {
        const Estimate* found = estimate(i);
        if (found == nullptr) return 1e6;
        Eigen::Matrix2d covariance;
        covariance << found->covariance[0], found->covariance[1], found->covariance[6], found->covariance[7];
        return error_m(i).dot(covariance.inverse() * error_m(i));
    }

  private:
    static ImuSample named(ImuSample sample, std::size_t i) {
        sample.tag = member(i);
        return sample;
    }
    void submit(const Observation& observation) {
        engine_->submit({walkers_[0].time(), ++sequence_, 0, observation}, walkers_[0].time());
    }
    double noise_m() { return model_.range_sigma_m * normal_(random_); }
    void hear_all(const Excess& excess) {
        for (std::size_t i = 0; i < team_size; ++i)
            for (std::size_t a = 0; a < anchors_.size(); ++a) {
                const Eigen::Vector2d anchor(anchors_[a].position_site_m[0], anchors_[a].position_site_m[1]);
                const double more_m = excess(a, i), noise = noise_m();
                if (!std::isnan(more_m))
                    submit(Range{anchors_[a].address, member(i),
                                 (walkers_[i].position_m() - anchor).norm() + more_m + noise});
            }
        for (std::size_t i = 0; i < team_size; ++i) {
            const std::size_t next = (i + 1) % team_size;
            const double noise = noise_m();
            const double apart_m = (walkers_[i].position_m() - walkers_[next].position_m()).norm();
            if (model_.peers) submit(PeerRange{member(i), member(next), std::max(0.01, apart_m + noise)});
        }
    }

    TeamModel model_;
    std::unique_ptr<Engine> engine_;
    std::vector<Anchor> anchors_;
    std::vector<SimulatedWalker> walkers_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::span<const Pose> poses_;
    std::uint32_t sequence_ = 0;
    int samples_ = 0;
};

} // namespace locus::test
