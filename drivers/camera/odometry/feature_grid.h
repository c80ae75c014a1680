// Features by their place in the picture: which lie within some pixels of a point.
#pragma once

#include "drivers/camera/odometry/features.h"

#include <algorithm>

namespace locus::camera {

class FeatureGrid {
  public:
    explicit FeatureGrid(const Features& features) : features_{features} {
        if (features.empty()) return;
        Eigen::Vector2d end_px = features.front().at_px;
        begin_px_ = end_px;
        for (const Feature& feature : features) {
            begin_px_ = begin_px_.cwiseMin(feature.at_px);
            end_px = end_px.cwiseMax(feature.at_px);
        }
        cells_ = ((end_px - begin_px_) / cell_px).cast<int>() + Eigen::Vector2i(1, 1);
        in_cell_.resize(static_cast<std::size_t>(cells_.x()) * static_cast<std::size_t>(cells_.y()));
        for (std::size_t i = 0; i < features.size(); ++i) {
            const Eigen::Vector2i cell = cell_of(features[i].at_px);
            in_cell_[index(cell.x(), cell.y())].push_back(i);
        }
    }

    /// Calls `take(index of a feature)` for those within the radius.
    template <class Take>
    void near(const Eigen::Vector2d& at_px, double radius_px, const Take& take) const {
        const Eigen::Vector2d reach_px(radius_px, radius_px);
        const Eigen::Vector2i first = cell_of(at_px - reach_px), last = cell_of(at_px + reach_px);
        for (int y = first.y(); y <= last.y(); ++y)
            for (int x = first.x(); x <= last.x(); ++x)
                for (const std::size_t i : in_cell_[index(x, y)])
                    if ((features_[i].at_px - at_px).squaredNorm() <= radius_px * radius_px) take(i);
    }

  private:
    static constexpr double cell_px = 24;

    Eigen::Vector2i cell_of(const Eigen::Vector2d& at_px) const {
        const Eigen::Vector2d cell = ((at_px - begin_px_) / cell_px).cwiseMax(0.).cwiseMin(1e6);
        return cell.cast<int>().cwiseMin(cells_ - Eigen::Vector2i(1, 1));
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_.x()) + static_cast<std::size_t>(x);
    }

    const Features& features_;
    Eigen::Vector2d begin_px_{0, 0};
    Eigen::Vector2i cells_{0, 0};
    std::vector<std::vector<std::size_t>> in_cell_;
};

} // namespace locus::camera
