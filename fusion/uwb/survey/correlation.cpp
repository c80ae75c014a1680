#include "fusion/uwb/survey/correlation.h"

#include <algorithm>
#include <cstddef>

namespace locus::uwb::survey {
namespace {

double product_sum(const std::vector<double>& series, double mean, std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < series.size(); ++i) sum += (series[i] - mean) * (series[i - lag] - mean);
    return sum;
}

} // namespace

double correlated_samples(const std::vector<double>& series) {
    if (series.size() < 4) return 1;
    double mean = 0;
    for (const double value : series) mean += value / static_cast<double>(series.size());
    const double variance = product_sum(series, mean, 0);
    if (variance <= 0) return 1;
    double time = -1;
    for (std::size_t lag = 0; lag + 1 < series.size() / 2; lag += 2) {
        const double pair = (product_sum(series, mean, lag) + product_sum(series, mean, lag + 1)) / variance;
        if (pair <= 0) break;
        time += 2 * pair;
    }
    return std::max(1.0, time);
}

} // namespace locus::uwb::survey
