#include "fusion/uwb/survey/survey.h"

#include "fusion/uwb/survey/folds.h"
#include "fusion/uwb/survey/scaling.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb::survey {
namespace {

/// Twice the difference of the logarithms of two likelihoods beyond which the lesser is ruled out: 1 in 400.
constexpr double ruled_out = 12;
constexpr double least_span_m = 0.3;

Eigen::Index row(std::size_t station) { return static_cast<Eigen::Index>(station); }

std::vector<std::size_t> known_of(const Task& task) {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < task.stations.size(); ++i)
        if (task.stations[i].known_site_m) known.push_back(i);
    return known;
}

double height_of(const Station& station) {
    return station.known_site_m ? station.known_site_m->z() : station.height_site_m.value_or(0);
}

Positions known_positions(const Task& task) {
    Positions known_m = Positions::Zero(row(task.stations.size()), 3);
    for (std::size_t i = 0; i < task.stations.size(); ++i) {
        known_m(row(i), 2) = height_of(task.stations[i]);
        if (const auto& at_m = task.stations[i].known_site_m) known_m.row(row(i)) = at_m->transpose();
    }
    return known_m;
}

/// Those that are known hold what they are known for; in two dimensions every height does.
void put_known(const Task& task, Positions& positions_m) {
    const Positions known_m = known_positions(task);
    if (task.dimensions() == 2) positions_m.col(2) = known_m.col(2);
    for (const std::size_t station : known_of(task)) positions_m.row(row(station)) = known_m.row(row(station));
}

/// Of a station that is known.
Eigen::Vector3d place_of(const Station& station) { return station.known_site_m.value_or(Eigen::Vector3d::Zero()); }

/// Pairs whose both ends are known count as what they are, and in two dimensions only the way along the floor counts.
std::vector<PairRange> for_scaling(const Task& task) {
    std::vector<PairRange> pairs = task.pairs;
    const auto known = known_of(task);
    for (std::size_t i = 0; i < known.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            pairs.push_back({known[i], known[j],
                             (place_of(task.stations[known[i]]) - place_of(task.stations[known[j]])).norm(), 1});
    if (task.dimensions() == 2)
        for (PairRange& pair : pairs) {
            const double rise_m = height_of(task.stations[pair.a]) - height_of(task.stations[pair.b]);
            pair.range_m = std::sqrt(std::max(pair.range_m * pair.range_m - rise_m * rise_m, 1e-4));
        }
    return pairs;
}

Survey in_trouble(Trouble trouble, std::vector<std::size_t> about = {}) {
    return {trouble, std::move(about), {}, {}, false, {}};
}

Trouble trouble_with_known(const Task& task) {
    const auto known = known_of(task);
    const auto needed = static_cast<std::size_t>(task.dimensions());
    if (known.empty()) return Trouble::none;
    if (known.size() < needed) return Trouble::known_too_few;
    Positions known_m(row(known.size()), 3);
    for (std::size_t i = 0; i < known.size(); ++i) known_m.row(row(i)) = place_of(task.stations[known[i]]).transpose();
    if (task.dimensions() == 2) known_m.col(2).setZero();
    return spans(known_m, task.dimensions() - 1, least_span_m) ? Trouble::none : Trouble::known_in_line;
}

/// Stations that fewer other stations measured than they have unknown coordinates, where all but themselves are fixed.
std::vector<std::size_t> poorly_measured(const Task& task) {
    std::vector<std::size_t> poor;
    for (std::size_t i = 0; i < task.stations.size(); ++i) {
        const auto own =
            std::ranges::count_if(task.pairs, [i](const auto& pair) { return pair.a == i || pair.b == i; });
        const auto enough = std::min(static_cast<std::size_t>(task.dimensions()), task.stations.size() - 1);
        if (!task.stations[i].known_site_m && static_cast<std::size_t>(own) < enough) poor.push_back(i);
    }
    return poor;
}

std::optional<Survey> refused(const Task& task) {
    const auto count = task.stations.size();
    if (count < static_cast<std::size_t>(task.dimensions()) + 1) return in_trouble(Trouble::too_few_stations);
    const auto group = groups(shortest_ways(for_scaling(task), count));
    std::vector<std::size_t> heads = group;
    std::ranges::sort(heads);
    heads.erase(std::unique(heads.begin(), heads.end()), heads.end());
    if (heads.size() > 1) return in_trouble(Trouble::disconnected, heads);
    if (const Trouble trouble = trouble_with_known(task); trouble != Trouble::none) return in_trouble(trouble);
    if (auto poor = poorly_measured(task); !poor.empty()) return in_trouble(Trouble::too_few_pairs, std::move(poor));
    return {};
}

/// Best shape without a frame.
Positions shape_of(const Task& task) {
    const int dimensions = task.dimensions();
    const auto count = row(task.stations.size());
    Positions start_m = classical_scaling(shortest_ways(for_scaling(task), task.stations.size()), dimensions);
    Sought sought = Sought::Constant(count, 3, true);
    if (dimensions == 2) {
        start_m.col(2) = known_positions(task).col(2);
        sought.col(2) = false;
    }
    return unfolded(task.pairs, sought, start_m, dimensions).position_m;
}

bool in_line(Positions shape_m, int dimensions) {
    if (dimensions == 2) shape_m.col(2).setZero();
    return !spans(shape_m, 2, least_span_m);
}

Sought sought_in_frame(const Task& task, const Survey& survey) {
    Sought sought = Sought::Constant(row(task.stations.size()), 3, true);
    if (task.dimensions() == 2) sought.col(2) = false;
    for (const std::size_t station : known_of(task)) sought.row(row(station)) = false;
    if (survey.by_convention) {
        sought.row(row(survey.frame[0])) = false;
        sought.row(row(survey.frame[1])).tail<2>() = false;
        sought(row(survey.frame[2]), 2) = false;
    }
    return sought;
}

/// Where single anchors may stand as well.
std::vector<Doubt> doubts_of(const Task& task, const Sought& sought, const Adjustment& best) {
    std::vector<Doubt> doubts;
    for (std::size_t i = 0; i < task.stations.size(); ++i) {
        const Descent other = folded(task.pairs, sought, best.position_m, i, task.dimensions());
        const Eigen::Vector3d apart_m = (other.position_m - best.position_m).row(row(i)).transpose();
        const double usual_m = best.sigma_m.row(row(i)).norm();
        if (other.cost - best.cost < ruled_out && apart_m.norm() > std::max(3 * usual_m, least_span_m))
            doubts.push_back({i, other.position_m.row(row(i)).transpose()});
    }
    return doubts;
}

Image image_of(const Task& task, const Survey& survey, const Positions& shape_m) {
    Positions start_m = survey.by_convention
                            ? by_convention(shape_m, survey.frame, task.dimensions(), task.third_on_right)
                            : by_known(shape_m, known_of(task), known_positions(task), task.dimensions());
    put_known(task, start_m);
    const Sought sought = sought_in_frame(task, survey);
    Image image{adjust(task.pairs, sought, start_m), {}};
    image.doubts = doubts_of(task, sought, image.adjustment);
    return image;
}

/// Positive where a station is left of the line between two others, seen from above.
double leftness(const Positions& at_m, const Mirror& mirror) {
    const Eigen::Vector2d along = (at_m.row(row(mirror.to)) - at_m.row(row(mirror.from))).head<2>().transpose();
    const Eigen::Vector2d aside = (at_m.row(row(mirror.station)) - at_m.row(row(mirror.from))).head<2>().transpose();
    return along.x() * aside.y() - along.y() * aside.x();
}

double what_tells(const Positions& at_m, const Mirror& mirror) {
    return mirror.by_height ? at_m(row(mirror.station), 2) : leftness(at_m, mirror);
}

/// The station that differs most, and the two fixed ones that stand farthest apart on the floor.
Mirror mirror_between(const std::vector<Image>& images, const std::vector<std::size_t>& fixed) {
    const Positions& one_m = images[0].adjustment.position_m;
    const Positions apart_m = images[1].adjustment.position_m - one_m;
    Eigen::Index most = 0;
    apart_m.rowwise().squaredNorm().maxCoeff(&most);
    Mirror mirror{static_cast<std::size_t>(most), false, fixed[0], fixed[1]};
    const auto length_m = [&](std::size_t a, std::size_t b) {
        return (one_m.row(row(a)) - one_m.row(row(b))).head<2>().norm();
    };
    for (const std::size_t a : fixed)
        for (const std::size_t b : fixed)
            if (length_m(a, b) > length_m(mirror.from, mirror.to)) mirror.from = a, mirror.to = b;
    mirror.by_height = std::abs(apart_m(most, 2)) > apart_m.row(most).head<2>().norm();
    return mirror;
}

void settle_mirror(Survey& survey, const std::vector<std::size_t>& fixed) {
    std::ranges::sort(survey.images, {}, [](const Image& image) { return image.adjustment.cost; });
    const double worse = survey.images[1].adjustment.cost - survey.images[0].adjustment.cost;
    const double apart_m =
        (survey.images[1].adjustment.position_m - survey.images[0].adjustment.position_m).rowwise().norm().maxCoeff();
    if (worse > ruled_out || apart_m < 1e-3) {
        survey.images.pop_back();
        return;
    }
    survey.mirror = mirror_between(survey.images, fixed);
    for (Image& image : survey.images) // the question settles this one
        std::erase_if(image.doubts, [&](const Doubt& doubt) { return doubt.station == survey.mirror->station; });
    std::ranges::sort(survey.images, std::greater{},
                      [&](const Image& image) { return what_tells(image.adjustment.position_m, *survey.mirror); });
}

} // namespace

int Task::dimensions() const {
    return std::ranges::all_of(stations, [](const auto& one) { return one.known_site_m || one.height_site_m; }) ? 2 : 3;
}

Survey survey(const Task& task) {
    if (auto trouble = refused(task)) return *std::move(trouble);
    const Positions shape_m = shape_of(task);
    auto fixed = known_of(task);
    Survey result;
    result.by_convention = fixed.empty();
    result.frame = frame_stations(shape_m);
    if (result.by_convention && in_line(shape_m, task.dimensions())) return in_trouble(Trouble::frame_in_line);
    if (result.by_convention) fixed.assign(result.frame.begin(), result.frame.begin() + 2);
    for (const bool image : {false, true})
        result.images.push_back(image_of(task, result, image ? mirrored(shape_m, task.dimensions()) : shape_m));
    settle_mirror(result, fixed);
    return result;
}

} // namespace locus::uwb::survey
