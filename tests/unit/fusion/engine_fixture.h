// What the engine's tests share: a small estimator whose state depends on the order of its measurements, so that any
// mistake in the timeline shows, and a site with four anchors.
#pragma once

#include "fusion/engine.h"

#include <cmath>
#include <cstring>

namespace locus::engine_test {

/// Follows the ranges it is given as if each were an x coordinate. It refuses what lies far from its state, gives way
/// after three refusals in a row (a reset), and needs two ranges to start.
class Follower final : public Estimator {
  public:
    Verdict update(const Measurement& measurement) noexcept override {
        const auto* range = std::get_if<Range>(&measurement.observation);
        if (range == nullptr) return {Exclusion::unsupported_kind};
        if (++heard_ < 2) return start(measurement.time, range->range_m), Verdict{Exclusion::waiting_for_start};
        const double dt_s = to_s(measurement.time - time_);
        const double innovation_m = range->range_m - (x_m_ + v_mps_ * dt_s);
        if (std::abs(innovation_m) > 3 && ++refused_in_a_row_ < 3) return {Exclusion::innovation_too_large};
        if (refused_in_a_row_ == 3) return reset(measurement.time, range->range_m), Verdict{};
        refused_in_a_row_ = 0;
        x_m_ += v_mps_ * dt_s + 0.3 * innovation_m;
        v_mps_ = 0.9 * v_mps_ + 0.1 * innovation_m;
        time_ = measurement.time;
        return {};
    }

    Estimate predict(Timestamp time) const noexcept override {
        Estimate estimate;
        estimate.time = time;
        estimate.position_site_m = {x_m_ + v_mps_ * to_s(time - time_), 0, 0};
        estimate.velocity_site_mps = {v_mps_, 0, 0};
        for (std::size_t i = 0; i < 6; ++i) estimate.covariance[i * 7] = 0.01;
        estimate.kinds_used = static_cast<std::uint32_t>(heard_);
        estimate.reset_count = resets_;
        estimate.missing = heard_ < 2 ? Missing::anchors : Missing::nothing;
        return estimate;
    }

    std::unique_ptr<Estimator> clone() const override { return std::make_unique<Follower>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const Follower&>(other); }

  private:
    void start(Timestamp time, double x_m) {
        time_ = time;
        x_m_ = x_m;
    }
    void reset(Timestamp time, double x_m) {
        start(time, x_m);
        refused_in_a_row_ = 0;
        ++resets_;
    }

    Timestamp time_{};
    double x_m_ = 0;
    double v_mps_ = 0;
    int heard_ = 0;
    int refused_in_a_row_ = 0;
    std::uint32_t resets_ = 0;
};

struct FollowerSettings {};

inline const EstimatorRow follower_row{
    "follower", "for tests", option_table<FollowerSettings>({}),
    [](const Site&, const void*) -> std::unique_ptr<Estimator> { return std::make_unique<Follower>(); }};

inline EngineSettings follower_settings() {
    EngineSettings settings;
    settings.fusion.estimator = "follower";
    settings.fusion.max_targets = 4;
    settings.fusion.window_s = 0.2;
    settings.fusion.lost_after_s = 1;
    settings.estimators.push_back({&follower_row, std::make_shared<FollowerSettings>()});
    const std::array<Vec3, 4> corners{{{0, 0, 0}, {10, 0, 3}, {10, 8, 0}, {0, 8, 3}}};
    for (std::uint64_t i = 0; i < corners.size(); ++i) {
        Anchor anchor;
        anchor.name = std::to_string(i);
        anchor.address = address(i);
        anchor.position_site_m = corners[i];
        settings.site.anchors.push_back(anchor);
    }
    settings.targets.push_back({"cart", address(100), {}});
    return settings;
}

constexpr Timestamp at(double s) { return timestamp_from_s(s); }

inline Measurement range(double time_s, double range_m, std::uint32_t sequence = 0, std::uint64_t anchor = 0,
                         std::uint64_t tag = 100) {
    Range observation;
    observation.anchor = address(anchor);
    observation.tag = address(tag);
    observation.range_m = range_m;
    return {at(time_s), sequence, 0, observation};
}

/// Bit for bit, but for padding.
inline bool same_bits(const Estimate& a, const Estimate& b) {
    const auto same = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    return a.time == b.time && same(a.position_site_m, b.position_site_m) &&
           same(a.velocity_site_mps, b.velocity_site_mps) && same(a.orientation_xyzw, b.orientation_xyzw) &&
           same(a.covariance, b.covariance) && a.kinds_used == b.kinds_used && a.reset_count == b.reset_count &&
           a.missing == b.missing;
}

} // namespace locus::engine_test
