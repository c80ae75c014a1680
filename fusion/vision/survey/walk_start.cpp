#include "fusion/vision/survey/walk_start.h"

#include "fusion/vision/survey/floor_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace locus::vision::survey {
namespace {

constexpr double offset_step_s = 0.2; ///< a walker's 0.14 m to either side: less than most poses err
constexpr std::size_t most_feet = 400;
constexpr int views_an_offset = 150; ///< with three people and a sixth of wrong feet a dozen of them are clean
constexpr int feet_a_view = 6;       ///< two more than needed: less noise, and few of them are on one line
constexpr std::size_t starts_kept = 3;

using Random = std::mt19937_64;

std::vector<SeenFoot> thinned(std::span<const SeenFoot> feet) {
    const std::size_t every = feet.size() / most_feet + 1;
    std::vector<SeenFoot> out;
    for (std::size_t i = 0; i < feet.size(); i += every) out.push_back(feet[i]);
    return out;
}

/// Pairs of one track each.
std::vector<std::vector<std::size_t>> by_track(const Matched& matched, std::span<const SeenFoot> feet) {
    std::vector<std::pair<std::uint32_t, std::size_t>> order;
    for (std::size_t i = 0; i < matched.feet.size(); ++i) order.emplace_back(feet[matched.feet[i]].track, i);
    std::ranges::sort(order);
    std::vector<std::vector<std::size_t>> tracks;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || order[i].first != order[i - 1].first) tracks.emplace_back();
        tracks.back().push_back(order[i].second);
    }
    return tracks;
}

std::size_t below(std::size_t size, Random& random) { return random() % size; }

/// Half of the pairs from one track, half from the same or another; longer tracks are drawn more often.
std::vector<FloorPair> drawn(const Matched& matched, const std::vector<std::vector<std::size_t>>& tracks,
                             Random& random) {
    std::vector<double> lengths;
    for (const auto& track : tracks) lengths.push_back(static_cast<double>(track.size()));
    std::discrete_distribution<std::size_t> any(lengths.begin(), lengths.end());
    const std::size_t first = any(random), second = below(2, random) ? first : any(random);
    std::vector<FloorPair> out;
    for (int i = 0; i < feet_a_view; ++i) {
        const auto& track = tracks[i % 2 ? first : second];
        out.push_back(matched.pairs[track[below(track.size(), random)]]);
    }
    return out;
}

/// From all pairs that are rather his than a stranger's.
std::optional<FloorView> again(const FloorView& view, const Matched& matched, const std::optional<Lens>& lens,
                               double stranger) {
    std::vector<FloorPair> his;
    for (const TimedPair& pair : matched.pairs)
        if (const Residual residual = residual_of(view, pair); residual.is_seen && residual.cost < stranger)
            his.push_back(pair);
    return start_view(his, lens);
}

/// The best at one offset.
class Best {
  public:
    Best(const Matched& matched, std::size_t feet, const std::optional<Lens>& lens, const WalkSettings& settings,
         double offset_s)
        : matched_(matched), feet_(feet), lens_(lens), settings_(settings), offset_s_(offset_s) {}

    void offer(const std::optional<FloorView>& view) {
        if (!view || !is_seen_from_above(*view)) return;
        const double cost = cost_of_view(*view, matched_, feet_, settings_);
        if (!best_ || cost < best_->cost) best_ = WalkStart{*view, offset_s_, cost};
    }
    void refine() {
        for (int i = 0; i < 3 && best_; ++i) offer(again(best_->view, matched_, lens_, stranger_cost(settings_)));
    }
    const std::optional<WalkStart>& best() const { return best_; }

  private:
    const Matched& matched_;
    std::size_t feet_;
    const std::optional<Lens>& lens_;
    const WalkSettings& settings_;
    double offset_s_;
    std::optional<WalkStart> best_;
};

std::optional<WalkStart> best_at(double offset_s, std::span<const SeenFoot> feet, const TaggedPath& path,
                                 const std::optional<Lens>& lens, const WalkSettings& settings, Random& random) {
    Matched matched = match(feet, path, offset_s, settings.pose_sigma_m);
    if (matched.pairs.size() < 2 * feet_a_view) return std::nullopt;
    for (TimedPair& pair : matched.pairs) // what the grid leaves of the offset, as if it were the pose's error
        pair.sigma_m = std::hypot(pair.sigma_m, pair.velocity_mps.norm() * offset_step_s / std::sqrt(12));
    const auto tracks = by_track(matched, feet);
    Best best(matched, feet.size(), lens, settings, offset_s);
    for (int i = 0; i < views_an_offset; ++i) best.offer(start_view(drawn(matched, tracks, random), lens));
    best.refine();
    return best.best();
}

} // namespace

Matched match(std::span<const SeenFoot> feet, const TaggedPath& path, double offset_s, double pose_sigma_m) {
    Matched out;
    for (std::size_t i = 0; i < feet.size(); ++i)
        if (const auto there = path.at(feet[i].time_s + offset_s)) {
            out.pairs.push_back(
                {{feet[i].pixel_px, there->site_m, feet[i].sigma_px, pose_sigma_m}, there->velocity_mps});
            out.feet.push_back(i);
        }
    return out;
}

double stranger_cost(const WalkSettings& settings) { return 2 * std::log(settings.image_px.prod()); }

double cost_of_view(const FloorView& view, const Matched& matched, std::size_t feet, const WalkSettings& settings) {
    const double most = stranger_cost(settings);
    double cost = most * static_cast<double>(feet - matched.pairs.size());
    for (const TimedPair& pair : matched.pairs) {
        const Residual residual = residual_of(view, pair);
        cost += residual.is_seen ? std::min(residual.cost, most) : most;
    }
    return cost / static_cast<double>(feet);
}

std::vector<WalkStart> start_walk(std::span<const SeenFoot> feet, const TaggedPath& path,
                                  const std::optional<Lens>& lens, const WalkSettings& settings) {
    const auto few = thinned(feet);
    Random random(1);
    std::vector<WalkStart> starts;
    const auto steps = std::lround((settings.most_offset_s - settings.least_offset_s) / offset_step_s);
    for (long step = 0; step <= steps; ++step) {
        const double offset_s = settings.least_offset_s + static_cast<double>(step) * offset_step_s;
        if (auto best = best_at(offset_s, few, path, lens, settings, random)) starts.push_back(*best);
    }
    std::ranges::sort(starts, {}, &WalkStart::cost);
    starts.resize(std::min(starts.size(), starts_kept), starts.empty() ? WalkStart{} : starts.front());
    return starts;
}

} // namespace locus::vision::survey
