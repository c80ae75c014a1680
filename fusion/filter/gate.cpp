#include "fusion/filter/gate.h"

#include <boost/math/distributions/chi_squared.hpp>

#include <cmath>

namespace locus::filter {

double gate_in_sigma(double false_alarm) {
    const boost::math::chi_squared one_degree_of_freedom(1);
    return std::sqrt(boost::math::quantile(boost::math::complement(one_degree_of_freedom, false_alarm)));
}

bool Gate::passes(double innovation_in_sigma, double limit_in_sigma, std::uint32_t patience) noexcept {
    const bool good = std::abs(innovation_in_sigma) <= limit_in_sigma;
    const bool reopened = !good && refused_ >= patience;
    in_doubt_ = !good;
    refused_ = good || reopened ? 0 : refused_ + 1;
    return good || reopened;
}

} // namespace locus::filter
