#include "fusion/filter/particles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::filter {
namespace {

constexpr std::size_t width = LaneRandom::width;

/// Sums side by side, so that the order of additions, and with it the result, is the same whatever the compiler.
struct LaneSum {
    LaneRandom::Lanes lanes{};
    double total() const {
        double sum = 0;
        for (const float lane : lanes) sum += double{lane};
        return sum;
    }
};

float narrow(double value) { return static_cast<float>(value); }

} // namespace

Particles::Particles(const ParticleSettings& settings) : settings_(settings), random_(settings.seed) {
    const auto room = (static_cast<std::size_t>(settings.max_count) + width - 1) / width * width;
    for (auto* arrays : {&parts_, &before_})
        for (Array& array : *arrays) array.assign(room, 0);
    weights_.assign(room, 0);
    passing_.assign(room, 1);
    settings_.min_count = std::min(settings.min_count, settings.max_count);
}

void Particles::copy_from(const Particles& other) noexcept {
    random_ = other.random_;
    count_ = other.count_;
    mean_ = other.mean_;
    covariance_ = other.covariance_;
    effective_size_ = other.effective_size_;
    const auto end = static_cast<std::ptrdiff_t>(other.lanes_end());
    for (std::size_t part = 0; part < part_count; ++part)
        std::copy(other.parts_[part].begin(), other.parts_[part].begin() + end, parts_[part].begin());
    std::copy(other.weights_.begin(), other.weights_.begin() + end, weights_.begin());
}

void Particles::start(const Vector4& mean, const Matrix4& covariance) noexcept {
    count_ = static_cast<std::size_t>(settings_.max_count);
    mean_ = mean;
    covariance_ = covariance;
    for (std::size_t part = 0; part < part_count; ++part)
        std::fill(parts_[part].begin(), parts_[part].end(), narrow(mean(static_cast<int>(part))));
    equal_weights();
    spread(count_);
    effective_size_ = static_cast<double>(count_);
}

void Particles::equal_weights() noexcept {
    std::fill(weights_.begin(), weights_.end(), 0.0f);
    std::fill_n(weights_.begin(), count_, 1 / static_cast<float>(count_));
}

void Particles::move(const ParticleMove& given) noexcept {
    before_[x].swap(parts_[x]);
    before_[y].swap(parts_[y]);
    const float re = narrow(given.move.x()), im = narrow(given.move.y()), place = narrow(given.place_sigma_m);
    const float any = narrow(given.drive_sigma), along = narrow(given.drive_length_sigma);
    const float across = narrow(given.drive_turn_sigma_rad);
    for (std::size_t i = 0; i < lanes_end(); i += width) {
        const auto a = random_.bell(), b = random_.bell(), c = random_.bell(), d = random_.bell();
        float* pu = &parts_[u][i];
        float* pv = &parts_[v][i];
        for (std::size_t lane = 0; lane < width; ++lane) {
            const float du = a[lane] * (any + along * pu[lane]) - b[lane] * (across * pv[lane]);
            const float dv = b[lane] * (any + across * pu[lane]) + a[lane] * (along * pv[lane]);
            const float mid_u = pu[lane] + 0.5f * du, mid_v = pv[lane] + 0.5f * dv;
            parts_[x][i + lane] = before_[x][i + lane] + re * mid_u - im * mid_v + place * c[lane];
            parts_[y][i + lane] = before_[y][i + lane] + re * mid_v + im * mid_u + place * d[lane];
            pu[lane] += du;
            pv[lane] += dv;
        }
    }
}

void Particles::begin_walls() noexcept { std::fill(passing_.begin(), passing_.end(), 1.0f); }

/// Two segments cross when each has the other's ends on both its sides.
void Particles::hit_wall(const Point& from_m, const Point& to_m) noexcept {
    const float ax = narrow(from_m.x()), ay = narrow(from_m.y());
    const float bx = narrow(to_m.x()), by = narrow(to_m.y());
    const float wx = bx - ax, wy = by - ay;
    const float* px = before_[x].data();
    const float* py = before_[y].data();
    const float* qx = parts_[x].data();
    const float* qy = parts_[y].data();
    for (std::size_t i = 0; i < lanes_end(); ++i) {
        const float before = wx * (py[i] - ay) - wy * (px[i] - ax), after = wx * (qy[i] - ay) - wy * (qx[i] - ax);
        const float mx = qx[i] - px[i], my = qy[i] - py[i];
        const float from = mx * (ay - py[i]) - my * (ax - px[i]), to = mx * (by - py[i]) - my * (bx - px[i]);
        const bool crosses = (before * after < 0.0f) & (from * to < 0.0f);
        passing_[i] = crosses ? 0.0f : passing_[i];
    }
}

/// A door that the plan does not know lets all through: where hardly any particle passes, the plan is wrong.
void Particles::end_walls() noexcept {
    constexpr double least_passing = 1e-2;
    LaneSum all, passing;
    for (std::size_t i = 0; i < lanes_end(); i += width)
        for (std::size_t lane = 0; lane < width; ++lane) {
            all.lanes[lane] += weights_[i + lane];
            passing.lanes[lane] += weights_[i + lane] * passing_[i + lane];
        }
    if (passing.total() < least_passing * all.total()) return;
    for (std::size_t i = 0; i < lanes_end(); ++i) weights_[i] *= passing_[i];
}

namespace {

/// ParticleNoise with what is common to all particles worked out.
struct Likelihood {
    float inverse_two_variance, tail, inverse_long2, inverse_short2;

    /// Split Cauchy tails under the bell, both scaled by the bell's peak.
    explicit Likelihood(const ParticleNoise& noise)
        : inverse_two_variance(narrow(0.5 / (noise.sigma_m * noise.sigma_m))),
          tail(
              narrow(noise.outlier_share / (1 - noise.outlier_share) * noise.sigma_m * std::sqrt(2 * std::numbers::pi) /
                     (0.5 * std::numbers::pi * (noise.long_tail_m + noise.short_tail_m)))),
          inverse_long2(narrow(1 / (noise.long_tail_m * noise.long_tail_m))),
          inverse_short2(narrow(1 / (noise.short_tail_m * noise.short_tail_m))) {}

    float operator()(float residual_m) const {
        const float square = residual_m * residual_m;
        const float out = square * (residual_m > 0.0f ? inverse_long2 : inverse_short2);
        return exp_of_negative(-square * inverse_two_variance) + tail / (1.0f + out);
    }
};

struct Anchor2 {
    float x, y, dz2;
    Anchor2(const Particles::Point& place_m, double dz_m)
        : x(narrow(place_m.x())), y(narrow(place_m.y())), dz2(narrow(dz_m * dz_m)) {}
    float distance(float px, float py) const { return std::sqrt((px - x) * (px - x) + (py - y) * (py - y) + dz2); }
};

} // namespace

void Particles::weigh_range(const Point& anchor_m, double dz_m, double range_m, const ParticleNoise& noise) noexcept {
    const Anchor2 anchor(anchor_m, dz_m);
    const Likelihood likelihood(noise);
    const float measured_m = narrow(range_m);
    const float* px = parts_[x].data();
    const float* py = parts_[y].data();
    float* weight = weights_.data();
    for (std::size_t i = 0; i < lanes_end(); ++i) weight[i] *= likelihood(measured_m - anchor.distance(px[i], py[i]));
}

void Particles::weigh_difference(const Point& a_m, double a_dz_m, const Point& b_m, double b_dz_m, double difference_m,
                                 const ParticleNoise& noise) noexcept {
    const Anchor2 a(a_m, a_dz_m), b(b_m, b_dz_m);
    const Likelihood likelihood(noise);
    const float measured_m = narrow(difference_m);
    const float* px = parts_[x].data();
    const float* py = parts_[y].data();
    float* weight = weights_.data();
    for (std::size_t i = 0; i < lanes_end(); ++i)
        weight[i] *= likelihood(measured_m - (b.distance(px[i], py[i]) - a.distance(px[i], py[i])));
}

void Particles::weigh_drive_length(double sigma) noexcept {
    const float inverse = narrow(0.5 / (sigma * sigma));
    for (std::size_t i = 0; i < lanes_end(); ++i) {
        const float off = std::sqrt(parts_[u][i] * parts_[u][i] + parts_[v][i] * parts_[v][i]) - 1.0f;
        weights_[i] *= exp_of_negative(-off * off * inverse);
    }
}

void Particles::redraw_drives(const Eigen::Vector2d& mean, double sigma) noexcept {
    const float re = narrow(mean.x()), im = narrow(mean.y()), spread = narrow(sigma);
    for (std::size_t i = 0; i < lanes_end(); i += width) {
        const auto a = random_.bell(), b = random_.bell();
        for (std::size_t lane = 0; lane < width; ++lane) {
            parts_[u][i + lane] = re + spread * a[lane];
            parts_[v][i + lane] = im + spread * b[lane];
        }
    }
}

void Particles::turn_drives(const Eigen::Vector2d& factor) noexcept {
    const float re = narrow(factor.x()), im = narrow(factor.y());
    for (std::size_t i = 0; i < lanes_end(); ++i) {
        const float old_u = parts_[u][i], old_v = parts_[v][i];
        parts_[u][i] = re * old_u - im * old_v;
        parts_[v][i] = re * old_v + im * old_u;
    }
}

void Particles::widen(double factor) noexcept {
    const float by = narrow(std::sqrt(factor));
    for (std::size_t part = 0; part < part_count; ++part) {
        const float centre = narrow(mean_(static_cast<int>(part)));
        for (std::size_t i = 0; i < lanes_end(); ++i) parts_[part][i] = centre + by * (parts_[part][i] - centre);
    }
    covariance_ *= factor;
}

/// Lanes behind the last particle weigh nothing, but a place that ran away to infinity would still make a sum NaN.
void Particles::hold_spare_lanes() noexcept {
    for (std::size_t part = 0; part < part_count; ++part)
        for (std::size_t i = count_; i < lanes_end(); ++i) parts_[part][i] = parts_[part][0];
}

bool Particles::settle() noexcept {
    hold_spare_lanes();
    LaneSum sum, squares;
    for (std::size_t i = 0; i < lanes_end(); i += width)
        for (std::size_t lane = 0; lane < width; ++lane) {
            const float weight = weights_[i + lane];
            sum.lanes[lane] += weight;
            squares.lanes[lane] += weight * weight;
        }
    const double total = sum.total();
    const bool alive = std::isfinite(total) && total > 1e-30 && squares.total() > 0;
    if (alive) {
        const float scale = narrow(1 / total);
        for (std::size_t i = 0; i < lanes_end(); ++i) weights_[i] *= scale;
    } else {
        equal_weights();
    }
    effective_size_ = alive ? total * total / squares.total() : static_cast<double>(count_);
    fill_moments();
    return alive;
}

/// About the old mean, so that single precision is enough far from the origin.
void Particles::fill_moments() noexcept {
    LaneSum first[part_count], second[10];
    const Eigen::Vector4f about = mean_.cast<float>();
    for (std::size_t i = 0; i < lanes_end(); i += width)
        for (std::size_t lane = 0; lane < width; ++lane) {
            const float w = weights_[i + lane];
            const float dx = parts_[x][i + lane] - about(0), dy = parts_[y][i + lane] - about(1);
            const float du = parts_[u][i + lane] - about(2), dv = parts_[v][i + lane] - about(3);
            const float wx = w * dx, wy = w * dy, wu = w * du, wv = w * dv;
            first[0].lanes[lane] += wx;
            first[1].lanes[lane] += wy;
            first[2].lanes[lane] += wu;
            first[3].lanes[lane] += wv;
            second[0].lanes[lane] += wx * dx;
            second[1].lanes[lane] += wx * dy;
            second[2].lanes[lane] += wx * du;
            second[3].lanes[lane] += wx * dv;
            second[4].lanes[lane] += wy * dy;
            second[5].lanes[lane] += wy * du;
            second[6].lanes[lane] += wy * dv;
            second[7].lanes[lane] += wu * du;
            second[8].lanes[lane] += wu * dv;
            second[9].lanes[lane] += wv * dv;
        }
    const Vector4 off(first[0].total(), first[1].total(), first[2].total(), first[3].total());
    mean_ = about.cast<double>() + off;
    for (int i = 0, next = 0; i < 4; ++i)
        for (int j = i; j < 4; ++j) covariance_(i, j) = covariance_(j, i) = second[next++].total() - off(i) * off(j);
}

} // namespace locus::filter
