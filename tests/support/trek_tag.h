// A tag among four anchors, as a TREK1000 tells it: what whole daemons are tested with.
#pragma once

#include "drivers/uwb/trek1000.h"

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

namespace locus::test {

class TrekTag {
  public:
    using Anchors = std::array<std::array<double, 3>, 4>;
    /// A hall of 10 m x 8 m.
    static constexpr Anchors hall_m{{{0, 0, 2.5}, {10, 0, 2.0}, {10, 8, 2.5}, {0, 8, 1.0}}};

    explicit TrekTag(const Anchors& anchors_m = hall_m, double range_noise_m = 0)
        : anchors_m_{anchors_m}, noise_m_{range_noise_m} {}

    /// The next report of the tag, at that place.
    uwb::TrekReport report_at(const Eigen::Vector3d& at_m) {
        uwb::TrekReport report;
        report.mask = 0xf;
        for (std::size_t i = 0; i < anchors_m_.size(); ++i) {
            const auto& [x, y, z] = anchors_m_[i];
            const double range_m = (at_m - Eigen::Vector3d(x, y, z)).norm() + noise_m_ * normal_(random_);
            report.range_mm[i] = static_cast<std::int32_t>(std::lround(1000 * range_m));
        }
        report.sequence = ++sequence_;
        return report;
    }

    /// The lines under `anchors:`, indented by four.
    std::string anchors_yaml() const {
        std::string lines;
        for (std::size_t i = 0; i < anchors_m_.size(); ++i)
            lines += fmt::format("    - {{name: A{0}, address: {0}, position_site_m: [{1}]}}\n", i,
                                 fmt::join(anchors_m_[i], ", "));
        return lines;
    }

  private:
    Anchors anchors_m_;
    double noise_m_;
    std::mt19937 random_{7};
    std::normal_distribution<double> normal_;
    std::uint8_t sequence_ = 0;
};

} // namespace locus::test
