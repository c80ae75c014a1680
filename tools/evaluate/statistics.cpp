#include "tools/evaluate/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace locus::evaluate {

namespace {

using Errors = std::vector<Eigen::Vector3d>;

template <class Magnitude>
std::vector<double> magnitudes(const Errors& errors, Magnitude magnitude) {
    std::vector<double> result;
    std::ranges::transform(errors, std::back_inserter(result), magnitude);
    return result;
}

std::vector<double> along(const Errors& errors, std::size_t axis) {
    return magnitudes(errors, [axis](const Eigen::Vector3d& e) { return std::abs(e[axis]); });
}

double mean(const Errors& errors, std::size_t axis) {
    double sum = 0;
    for (const auto& error : errors) sum += error[axis];
    return sum / static_cast<double>(errors.size());
}

Errors less(Errors errors, const std::array<double, 3>& bias_m) {
    for (auto& error : errors) error -= Eigen::Vector3d(bias_m[0], bias_m[1], bias_m[2]);
    return errors;
}

double horizontal(const Eigen::Vector3d& error) { return error.head<2>().norm(); }

std::optional<Coverage> coverage(std::span<const double> errors_m, std::span<const Pair> pairs, double Pair::* bound_m,
                                 double scale) {
    Coverage result;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double bound = scale * pairs[i].*bound_m;
        if (!std::isfinite(bound)) continue;
        ++result.count;
        result.share += errors_m[i] <= bound;
        result.mean_bound_m += bound;
    }
    if (result.count == 0) return std::nullopt;
    result.share /= static_cast<double>(result.count);
    result.mean_bound_m /= static_cast<double>(result.count);
    return result;
}

} // namespace

double quantile(std::span<const double> sorted, double part) {
    const double at = part * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const auto above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

Figures figures(std::vector<double> errors_m) {
    std::ranges::sort(errors_m);
    const auto count = static_cast<double>(errors_m.size());
    const double squares = std::inner_product(errors_m.begin(), errors_m.end(), errors_m.begin(), 0.0);
    return {std::sqrt(squares / count), std::accumulate(errors_m.begin(), errors_m.end(), 0.0) / count,
            quantile(errors_m, 0.5),    quantile(errors_m, 0.8),
            quantile(errors_m, 0.95),   errors_m.back()};
}

std::vector<Eigen::Vector3d> errors(std::span<const Pair> pairs, const Similarity& similarity) {
    Errors result;
    for (const auto& pair : pairs) result.emplace_back(similarity(pair.estimate_m) - pair.truth_m);
    return result;
}

Statistics statistics(std::span<const Pair> pairs, const Similarity& similarity) {
    const Errors all = errors(pairs, similarity);
    const auto in_plane = magnitudes(all, horizontal);
    Statistics result;
    result.spatial = figures(magnitudes(all, [](const Eigen::Vector3d& e) { return e.norm(); }));
    result.horizontal = figures(in_plane);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result.axes[axis] = figures(along(all, axis));
        result.bias_m[axis] = mean(all, axis);
    }
    const Errors centred = less(all, result.bias_m);
    for (std::size_t axis = 0; axis < 3; ++axis) result.axes_less_bias[axis] = figures(along(centred, axis));
    result.horizontal_less_bias = figures(magnitudes(centred, horizontal));
    result.horizontal_coverage = coverage(in_plane, pairs, &Pair::horizontal_bound_m, similarity.scale);
    result.vertical_coverage = coverage(along(all, 2), pairs, &Pair::vertical_bound_m, similarity.scale);
    return result;
}

} // namespace locus::evaluate
