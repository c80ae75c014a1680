#include "fusion/vision/association.h"

#include "fusion/vision/box_geometry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace locus::vision {
namespace {

using Indices = std::vector<std::size_t>;

constexpr double never = std::numeric_limits<double>::infinity();

std::optional<FloorPoint> foot_of(const FloorView& floor, const BoxPx& box, const BoxNoise& noise) noexcept {
    const double sigma_px = noise.edge * box.height_px;
    const Eigen::Vector2d foot_px(box.left_px + 0.5 * box.width_px, box.bottom_px());
    return foot_on_floor(floor, {foot_px, sigma_px * sigma_px * Eigen::Matrix2d::Identity()});
}

/// A box of a real detector: numbers within any image, and some extent.
bool is_usable(const Detection& detection) noexcept {
    constexpr float farthest_px = 1e6F;
    const auto& [left, top, width, height] = detection.box;
    return std::abs(left) < farthest_px && std::abs(top) < farthest_px && width > 0 && width < farthest_px &&
           height > 0 && height < farthest_px && std::isfinite(detection.score);
}

class Matching {
  public:
    Matching(std::span<const Track> tracks, std::span<const Detection> detections, const TrackerSettings& settings,
             const FloorView* floor)
        : tracks_(tracks), detections_(detections), settings_(settings), floor_(floor), has_(tracks.size(), false),
          is_taken_(detections.size(), false) {}

    /// All at once: the likelihood knows that the wide ellipse of somebody long unseen says little.
    void by_motion_and_looks() {
        const Indices confirmed = open_tracks([](const Track& track) { return track.is_confirmed; });
        pair_up(confirmed, open_detections(true), 1, [&](auto i, auto j) { return motion_and_looks(i, j); });
    }

    /// Those seen last have the first choice, then those unseen for longer, step by step.
    void by_cascade() {
        Indices confirmed = open_tracks([](const Track& track) { return track.is_confirmed; });
        std::stable_sort(confirmed.begin(), confirmed.end(),
                         [&](auto a, auto b) { return tracks_[a].unseen_s < tracks_[b].unseen_s; });
        for (auto first = confirmed.begin(); first != confirmed.end();) {
            const auto last = std::find_if(first, confirmed.end(),
                                           [&](auto i) { return tracks_[i].unseen_s > tracks_[*first].unseen_s; });
            pair_up({first, last}, open_detections(true), 1, [&](auto i, auto j) { return motion_and_looks(i, j); });
            first = last;
        }
    }

    void by_overlap(bool strong, double least_iou, bool with_tentative) {
        const Indices open = open_tracks([&](const Track& track) { return track.is_confirmed || with_tentative; });
        pair_up(open, open_detections(strong), 1 - least_iou, [&](auto i, auto j) {
            const double overlap = iou(tracks_[i].filter.box(), detections_[j].box);
            return can_walk(tracks_[i], detections_[j].box) ? 1 - overlap : never;
        });
    }

    Association result() {
        std::sort(pairs_.begin(), pairs_.end());
        return {std::move(pairs_), open_detections(true)};
    }

  private:
    std::span<const Track> tracks_;
    std::span<const Detection> detections_;
    const TrackerSettings& settings_;
    const FloorView* floor_;
    std::vector<bool> has_, is_taken_;
    Pairing pairs_;

    template <class Wanted>
    Indices open_tracks(const Wanted& wanted) const {
        Indices open;
        for (std::size_t i = 0; i < tracks_.size(); ++i)
            if (!has_[i] && wanted(tracks_[i])) open.push_back(i);
        return open;
    }

    Indices open_detections(bool strong) const {
        Indices open;
        for (std::size_t j = 0; j < detections_.size(); ++j)
            if (!is_taken_[j] && is_usable(detections_[j]) &&
                (detections_[j].score >= settings_.strong_score) == strong)
                open.push_back(j);
        return open;
    }

    template <class Cost>
    void pair_up(const Indices& rows, const Indices& columns, double limit, const Cost& cost) {
        Costs costs(rows.size(), columns.size());
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < columns.size(); ++j) costs.at(i, j) = cost(rows[i], columns[j]);
        for (const auto& [i, j] : assign(costs, limit)) {
            has_[rows[i]] = is_taken_[columns[j]] = true;
            pairs_.emplace_back(rows[i], columns[j]);
        }
    }

    /// Below 1 when it is likelier that the detection is his than that he was not seen. Motion: minus twice the
    /// logarithm of the likelihood, up to what is the same for all tracks, in units of the gate.
    double motion_and_looks(std::size_t i, std::size_t j) const {
        const auto distance = tracks_[i].filter.distance(detections_[j].box);
        if (!(distance.mahalanobis2 < settings_.gate) || !can_walk(tracks_[i], detections_[j].box)) return never;
        const double motion = (distance.mahalanobis2 + distance.log_doubt) / settings_.gate;
        const auto looks = tracks_[i].gallery.distance(detections_[j].appearance);
        if (!looks) return motion;
        if (*looks > settings_.max_appearance_distance) return never;
        const double weight = settings_.appearance_weight;
        return (1 - weight) * motion + weight * *looks / settings_.max_appearance_distance;
    }

    bool can_walk(const Track& track, const BoxPx& box) const noexcept {
        if (!floor_) return true;
        const auto from = foot_of(*floor_, track.seen_box, settings_);
        const auto to = foot_of(*floor_, box, settings_);
        if (!from || !to) return true; // where the floor is not seen, nothing is known
        const double sigma_m = std::sqrt((from->covariance_m2 + to->covariance_m2).trace());
        const double way_m = (to->position_site_m - from->position_site_m).norm();
        return way_m <= settings_.max_speed_mps * track.unseen_s + 3 * sigma_m;
    }
};

} // namespace

Association associate(std::span<const Track> tracks, std::span<const Detection> detections,
                      const TrackerSettings& settings, const FloorView* floor) {
    Matching matching(tracks, detections, settings, floor);
    settings.cascade ? matching.by_cascade() : matching.by_motion_and_looks();
    matching.by_overlap(true, settings.least_iou, true);
    matching.by_overlap(false, settings.weak_iou, false);
    return matching.result();
}

} // namespace locus::vision
