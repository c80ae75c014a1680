#include "fusion/radio/gaussian_field.h"

#include "fusion/radio/field_evidence.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace locus::radio {
namespace {

constexpr Eigen::Index most_search_points = 64, most_search_beacons = 48;
constexpr Eigen::Index corners_at_a_time = 512;
/// What weighs less in a mixture is not worth its time.
constexpr double least_hypothesis = 0.01, least_source = 0.003;
/// Beacons heard at fewer points say nothing of how they fall off; in a map so small that is all there are.
constexpr std::size_t enough_points = 3;
constexpr double most_lost = 0.95;

struct WeightedHypothesis {
    FieldHypothesis hypothesis;
    double weight = 0;
};

/// Of single strengths about their beacon's mean.
double spread_db(const FieldData& data) {
    const Eigen::MatrixXd off = data.strengths_dbm.rowwise() - data.strengths_dbm.colwise().mean();
    return std::max(1.0, std::sqrt(off.squaredNorm() / static_cast<double>(off.size())));
}

/// From well below the spacing of points to the whole map; deviations from hardly any to more than all there is.
std::vector<FieldHypothesis> hypotheses(const FieldData& data, double spacing_m) {
    constexpr std::array lengths{0.6, 1.2, 2.5, 5.0, 10.0, 20.0};
    constexpr std::array shared{0.2, 0.35, 0.6, 1.0, 1.6};
    constexpr std::array own{0.15, 0.25, 0.4, 0.6, 0.9, 1.3};
    const double all_db = spread_db(data);
    std::vector<FieldHypothesis> list;
    for (const double length : lengths)
        for (const double s : shared)
            for (const double o : own) list.push_back({length * spacing_m, s * all_db, o * all_db});
    return list;
}

/// The likely ones; of a map with more points than are searched only the best, for there the others weigh nothing.
std::vector<WeightedHypothesis> likely(const FieldData& data, double spacing_m) {
    const FieldData search = thinned(data, most_search_points, most_search_beacons);
    std::vector<WeightedHypothesis> all;
    for (const FieldHypothesis& each : hypotheses(search, spacing_m))
        all.push_back({each, FieldEvidence(search, each).total()});
    const double best = std::ranges::max_element(all, {}, &WeightedHypothesis::weight)->weight;
    const bool is_whole = search.points_m.rows() == data.points_m.rows();
    const double least = is_whole ? std::log(least_hypothesis) : 0;
    std::erase_if(all, [&](const WeightedHypothesis& each) { return each.weight - best < least; });
    double sum = 0;
    for (WeightedHypothesis& each : all) sum += each.weight = std::exp(each.weight - best);
    for (WeightedHypothesis& each : all) each.weight /= sum;
    return all;
}

/// A beacon that sends from one source, under one hypothesis.
struct Part {
    double weight = 0;
    std::size_t source = 0;
    Eigen::Vector2d loss{0, 0};
    Eigen::VectorXd off_dbm; ///< of the points, from what the path loss alone lets expect
};

std::vector<Part> parts_of(const FieldData& data, const FieldEvidence& evidence, Eigen::Index beacon) {
    const Eigen::RowVectorXd logs = evidence.of_sources().row(beacon);
    const Eigen::RowVectorXd weights = (logs.array() - logs.maxCoeff()).exp();
    const double sum = weights.sum();
    std::vector<Part> parts;
    for (std::size_t s = 0; s < data.sources_m.size(); ++s) {
        const double weight = weights(static_cast<Eigen::Index>(s)) / sum;
        if (weight < least_source) continue;
        const Eigen::Vector2d loss = evidence.loss(beacon, s);
        parts.push_back({weight, s, loss, data.strengths_dbm.col(beacon) - data.bases[s] * loss});
    }
    return parts;
}

/// Sums over the mixture, of all beacons and corners: weight, mean and square.
struct Moments {
    Eigen::MatrixXd weight, mean, square; ///< corners x beacons

    Moments(Eigen::Index corners, Eigen::Index beacons)
        : weight(Eigen::MatrixXd::Zero(corners, beacons)), mean(weight), square(weight) {}
    void add(Eigen::Index first, Eigen::Index beacon, double share, const Eigen::ArrayXd& mean_dbm,
             const Eigen::ArrayXd& variance_db2) {
        const Eigen::Index count = mean_dbm.size();
        weight.col(beacon).segment(first, count).array() += share;
        mean.col(beacon).segment(first, count).array() += share * mean_dbm;
        square.col(beacon).segment(first, count).array() += share * (variance_db2 + mean_dbm.square());
    }
};

/// Rasmussen and Williams 2006, eq. 2.41-2.42.
void add_corners(const FieldData& data, const FieldEvidence& evidence, const WeightedHypothesis& given,
                 const std::vector<std::vector<Part>>& parts, const FloorPoints& corners_m, Eigen::Index first,
                 Moments& moments) {
    const FieldHypothesis& h = given.hypothesis;
    const Eigen::MatrixXd shared = shared_covariance(data.points_m, corners_m, h);
    const Eigen::MatrixXd gains = evidence.points().solve(shared);
    const Eigen::ArrayXd known = shared.cwiseProduct(gains).colwise().sum().transpose();
    const Eigen::ArrayXd left = (h.shared_db * h.shared_db - known).max(0.0) + h.own_db * h.own_db;
    for (std::size_t b = 0; b < parts.size(); ++b)
        for (const Part& part : parts[b]) {
            const LossBasis here = loss_basis(corners_m, data.sources_m[part.source]);
            const LossBasis unknown = here - gains.transpose() * data.bases[part.source];
            const Eigen::ArrayXd by_loss =
                (unknown * evidence.loss_covariance(part.source)).cwiseProduct(unknown).rowwise().sum();
            const Eigen::ArrayXd mean = here * part.loss + gains.transpose() * part.off_dbm;
            moments.add(first, static_cast<Eigen::Index>(b), given.weight * part.weight, mean, left + by_loss);
        }
}

FloorPoints corners_of(const FloorCells& cells) {
    FloorPoints corners(static_cast<Eigen::Index>(cells.count()), 2);
    for (Eigen::Index i = 0; i < corners.rows(); ++i) corners.row(i) = cells.place_site_m(static_cast<std::size_t>(i));
    return corners;
}

void add_hypothesis(const FieldData& data, const WeightedHypothesis& given, const FloorPoints& corners_m,
                    Moments& moments) {
    const FieldEvidence evidence(data, given.hypothesis);
    std::vector<std::vector<Part>> parts;
    for (Eigen::Index b = 0; b < data.strengths_dbm.cols(); ++b) parts.push_back(parts_of(data, evidence, b));
    for (Eigen::Index first = 0; first < corners_m.rows(); first += corners_at_a_time) {
        const Eigen::Index count = std::min(corners_at_a_time, corners_m.rows() - first);
        add_corners(data, evidence, given, parts, corners_m.middleRows(first, count), first, moments);
    }
}

/// The most often heard, where there are more than memory is meant for.
std::vector<Address> beacons_for(const RadioMap& map) {
    std::vector<Address> beacons = beacons_of(map, std::min(enough_points, map.points.size()));
    for (std::size_t least = enough_points + 1; beacons.size() > max_beacons; ++least) beacons = beacons_of(map, least);
    return beacons;
}

bool is_near(const ReferencePoint& a, const ReferencePoint& b, double reach_m) {
    return std::hypot(a.position_site_m[0] - b.position_site_m[0], a.position_site_m[1] - b.position_site_m[1]) <=
           reach_m;
}

/// How often a beacon is missing at a point although it was heard near by: what a scan loses, by the map's own word.
/// Too much rather than too little: some of it lies at the rim of a beacon's reach.
double lost_by_map(const RadioMap& map, const std::vector<Address>& beacons) {
    std::size_t heard = 0, lost = 0;
    const double reach_m = hole_reach_m(map);
    const auto near_by = [&](const ReferencePoint& point, Address beacon) {
        return std::ranges::any_of(map.points, [&](const ReferencePoint& other) {
            return is_near(point, other, reach_m) && find(other, beacon) != nullptr;
        });
    };
    for (const Address beacon : beacons)
        for (const ReferencePoint& point : map.points) {
            if (find(point, beacon) != nullptr)
                ++heard;
            else if (near_by(point, beacon))
                ++lost;
        }
    return static_cast<double>(lost) / static_cast<double>(std::max<std::size_t>(1, lost + heard));
}

/// A survey goes where people go: the farther from its points, the less likely is anybody, by a bell of a few spacings.
void set_priors(const RadioMap& map, StrengthGrid& grid) {
    constexpr double prior_spacings = 3;
    const double reach_m = prior_spacings * point_spacing_m(map);
    for (std::size_t corner = 0; corner < grid.cells().count(); ++corner) {
        const Eigen::Vector2d place = grid.cells().place_site_m(corner);
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const ReferencePoint& point : map.points)
            nearest_m = std::min(
                nearest_m, std::hypot(point.position_site_m[0] - place.x(), point.position_site_m[1] - place.y()));
        const double reaches = nearest_m / reach_m;
        grid.set_prior(corner, static_cast<float>(-0.5 * reaches * reaches));
    }
}

} // namespace

FloorCells cells_of(const RadioMap& map, std::size_t most_corners) {
    if (map.points.empty()) throw std::invalid_argument("a radio map without points says nothing");
    Eigen::Vector2d low(map.points[0].position_site_m[0], map.points[0].position_site_m[1]), high = low;
    for (const ReferencePoint& point : map.points) {
        const Eigen::Vector2d place(point.position_site_m[0], point.position_site_m[1]);
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    const double half_m = 0.5 * point_spacing_m(map);
    const Eigen::Vector2d margin_m = Eigen::Vector2d::Constant(half_m);
    return cells_over(low - margin_m, high + margin_m, half_m, most_corners);
}

StrengthGrid gaussian_field(const RadioMap& map, const FieldSettings& settings) {
    const FloorCells cells = cells_of(map, settings.most_corners);
    const std::vector<Address> beacons = beacons_for(map);
    if (beacons.empty()) throw std::invalid_argument("no beacon of the radio map was heard at three points or more");
    const FieldData data = field_data(map, beacons);
    const FloorPoints corners_m = corners_of(cells);
    Moments moments(corners_m.rows(), data.strengths_dbm.cols());
    for (const WeightedHypothesis& each : likely(data, point_spacing_m(map)))
        add_hypothesis(data, each, corners_m, moments);
    StrengthGrid grid(cells, beacons, hearing_floor_dbm(map));
    for (Eigen::Index b = 0; b < moments.mean.cols(); ++b)
        for (Eigen::Index c = 0; c < moments.mean.rows(); ++c) {
            const double mean = moments.mean(c, b) / moments.weight(c, b);
            const double variance = std::max(1.0, moments.square(c, b) / moments.weight(c, b) - mean * mean);
            grid.set(static_cast<std::size_t>(b), static_cast<std::size_t>(c),
                     {static_cast<float>(mean), static_cast<float>(variance)});
        }
    grid.finish(std::clamp(lost_by_map(map, beacons), settings.lost_share, most_lost));
    set_priors(map, grid);
    return grid;
}

} // namespace locus::radio
