// Resampling of a particle cloud: how many are wanted, which ones go on, and how they are spread.
#include "fusion/filter/particles.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>

namespace locus::filter {
namespace {

constexpr int bins_across = 32, directions = 8;

int bin_of(float value, double bin) {
    const auto index = static_cast<int>(std::floor(double{value} / bin)) + bins_across / 2;
    return std::clamp(index, 0, bins_across - 1);
}

int direction_of(float u, float v) {
    const double turns = std::atan2(double{v}, double{u}) / (2 * std::numbers::pi) + 0.5;
    return std::min(directions - 1, static_cast<int>(turns * directions));
}

/// A bandwidth for `count` samples of a normal distribution of four dimensions (Silverman 1986, eq. 4.14).
double optimal_bandwidth(std::size_t count) {
    return std::pow(4.0 / (4 + 2), 1.0 / (4 + 4)) * std::pow(static_cast<double>(count), -1.0 / (4 + 4));
}

} // namespace

void Particles::resample_if_poor() noexcept {
    if (effective_size_ >= settings_.resample_below * static_cast<double>(count_)) return;
    const std::size_t count = wanted_count();
    choose(count);
    count_ = count;
    equal_weights();
    effective_size_ = static_cast<double>(count_);
    if (settings_.kernel_share <= 0) return;
    const double h = settings_.kernel_share * optimal_bandwidth(count_);
    const Matrix4 whole = covariance_;
    const float keep = static_cast<float>(std::sqrt(std::max(0.0, 1 - h * h)));
    for (std::size_t part = 0; part < part_count; ++part) {
        const auto centre = static_cast<float>(mean_(static_cast<int>(part)));
        for (float& value : parts_[part]) value = centre + keep * (value - centre);
    }
    covariance_ = h * h * whole;
    spread(count_);
    covariance_ = whole;
}

/// Fox 2003, eq. 7: samples that keep the Kullback-Leibler distance small, for so many bins with something in them.
std::size_t Particles::wanted_count() const noexcept {
    const auto least = static_cast<double>(settings_.min_count), most = static_cast<double>(settings_.max_count);
    const auto free_bins = static_cast<double>(bins_in_use()) - 1;
    if (free_bins < 1) return static_cast<std::size_t>(least);
    const double spread = 2 / (9 * free_bins);
    const double wanted =
        free_bins / (2 * settings_.kld_error) * std::pow(1 - spread + std::sqrt(spread) * settings_.kld_quantile, 3);
    return static_cast<std::size_t>(std::clamp(wanted, least, most));
}

std::size_t Particles::bins_in_use() const noexcept {
    constexpr float worth_counting = 0.1f; // of a mean weight
    std::bitset<static_cast<std::size_t>(bins_across) * bins_across * directions> used;
    const float least = worth_counting / static_cast<float>(count_);
    for (std::size_t i = 0; i < count_; ++i) {
        if (weights_[i] < least) continue;
        const int column = bin_of(parts_[x][i] - static_cast<float>(mean_(0)), settings_.bin_m);
        const int row = bin_of(parts_[y][i] - static_cast<float>(mean_(1)), settings_.bin_m);
        const int bin = (row * bins_across + column) * directions + direction_of(parts_[u][i], parts_[v][i]);
        used.set(static_cast<std::size_t>(bin));
    }
    return used.count();
}

/// Systematic resampling: one random number, then a comb over the sum of weights (Kitagawa 1996).
void Particles::choose(std::size_t count) noexcept {
    const double tooth = 1 / static_cast<double>(count);
    auto reached = double{weights_[0]};
    double wanted = tooth * double{random_.uniform()};
    std::size_t from = 0;
    for (std::size_t to = 0; to < count; ++to) {
        while (reached < wanted && from + 1 < count_) reached += double{weights_[++from]};
        for (std::size_t part = 0; part < part_count; ++part) before_[part][to] = parts_[part][from];
        wanted += tooth;
    }
    for (std::size_t part = 0; part < part_count; ++part) before_[part].swap(parts_[part]);
}

/// Adds noise of the covariance that is kept.
void Particles::spread(std::size_t count) noexcept {
    const Matrix4 safe = covariance_ + 1e-12 * Matrix4::Identity();
    const Eigen::Matrix4f root = Matrix4(safe.llt().matrixL()).cast<float>();
    for (std::size_t i = 0; i < count; i += LaneRandom::width) {
        const std::array noise{random_.bell(), random_.bell(), random_.bell(), random_.bell()};
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column <= row; ++column)
                for (std::size_t lane = 0; lane < LaneRandom::width; ++lane)
                    parts_[static_cast<std::size_t>(row)][i + lane] +=
                        root(row, column) * noise[static_cast<std::size_t>(column)][lane];
    }
}

} // namespace locus::filter
