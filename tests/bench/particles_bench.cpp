// A particle filter's observation update beside MRPT's, in one program: 1,000 particles, 4 ranges of 10 cm, weights
// made to sum one and moments. MRPT's particles are moved and weighed by the same model through its own interface, with
// its own weights in logarithms. Particles a second are the figure.
#include "fusion/filter/particles.h"

#include <benchmark/benchmark.h>

#if __has_include(<mrpt/bayes/CParticleFilterData.h>)
#include <mrpt/bayes/CParticleFilterCapable.h>
#include <mrpt/bayes/CParticleFilterData.h>
#include <mrpt/random/RandomGenerators.h>
#define LOCUS_MRPT 1
#endif

#include <array>
#include <cmath>

namespace {

using locus::filter::ParticleNoise;
using locus::filter::Particles;
using locus::filter::ParticleSettings;

constexpr int count = 1000;
constexpr std::array<std::array<double, 2>, 4> anchors{{{0, 0}, {30, 0}, {30, 24}, {0, 24}}};
constexpr double true_x = 12, true_y = 9, sigma_m = 0.1;

double range_to(std::size_t anchor) { return std::hypot(true_x - anchors[anchor][0], true_y - anchors[anchor][1]); }

ParticleSettings thousand() {
    ParticleSettings settings;
    settings.max_count = settings.min_count = count;
    return settings;
}

void weigh(Particles& cloud) {
    ParticleNoise noise;
    noise.sigma_m = sigma_m;
    for (std::size_t i = 0; i < anchors.size(); ++i)
        cloud.weigh_range({anchors[i][0], anchors[i][1]}, 0, range_to(i), noise);
}

Particles started() {
    Particles cloud(thousand());
    cloud.start({true_x, true_y, 1, 0}, Eigen::Vector4d(0.01, 0.01, 0.04, 0.04).asDiagonal());
    return cloud;
}

/// 4 ranges, weights, moments.
void particles_update(benchmark::State& state) {
    Particles cloud = started();
    const Particles fresh = cloud;
    for (auto _ : state) {
        weigh(cloud);
        benchmark::DoNotOptimize(cloud.settle());
        cloud.copy_from(fresh); // else all weight ends on one
    }
    state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(particles_update);

/// Move, 4 ranges, weights, moments, resampling where it is due.
void particles_epoch(benchmark::State& state) {
    Particles cloud = started();
    for (auto _ : state) {
        cloud.move({{0, 0}, 0.05, 0.05});
        weigh(cloud);
        benchmark::DoNotOptimize(cloud.settle());
        cloud.resample_if_poor();
    }
    state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(particles_epoch);

#ifdef LOCUS_MRPT
struct Walker {
    double x = true_x, y = true_y, u = 1, v = 0;
};

using Data = mrpt::bayes::CParticleFilterData<Walker, mrpt::bayes::particle_storage_mode::VALUE>;

/// The model through MRPT's interface: the caller moves and weighs m_particles, MRPT normalises and resamples.
class MrptWalkers : public mrpt::bayes::CParticleFilterDataImpl<MrptWalkers, Data::CParticleList>, public Data {
  public:
    MrptWalkers() {
        m_particles.resize(count);
        for (auto& particle : m_particles) particle.d = draw(0.1);
    }
    static Walker draw(double sigma) {
        auto& random = mrpt::random::getRandomGenerator();
        return {random.drawGaussian1D(true_x, sigma), random.drawGaussian1D(true_y, sigma), 1, 0};
    }
    void move() {
        auto& random = mrpt::random::getRandomGenerator();
        for (auto& particle : m_particles) {
            particle.d.x += random.drawGaussian1D(0, 0.05);
            particle.d.y += random.drawGaussian1D(0, 0.05);
            particle.d.u += random.drawGaussian1D(0, 0.05);
            particle.d.v += random.drawGaussian1D(0, 0.05);
        }
    }
    void weigh() {
        for (auto& particle : m_particles) {
            double log_weight = 0;
            for (std::size_t i = 0; i < anchors.size(); ++i) {
                const double off = range_to(i) - std::hypot(particle.d.x - anchors[i][0], particle.d.y - anchors[i][1]);
                log_weight += -0.5 * off * off / (sigma_m * sigma_m);
            }
            particle.log_w += log_weight;
        }
        normalizeWeights();
    }
    std::array<double, 5> moments() const {
        std::array<double, 5> sum{};
        for (const auto& particle : m_particles) {
            const double w = std::exp(particle.log_w);
            const double dx = particle.d.x - true_x, dy = particle.d.y - true_y;
            sum[0] += w * dx;
            sum[1] += w * dy;
            sum[2] += w * dx * dx;
            sum[3] += w * dx * dy;
            sum[4] += w * dy * dy;
        }
        return sum;
    }
    void resample_if_poor() {
        if (ESS() < 0.5) performResampling({});
    }
    void forget_weights() {
        for (auto& particle : m_particles) particle.log_w = 0;
    }
};

void mrpt_update(benchmark::State& state) {
    MrptWalkers cloud;
    for (auto _ : state) {
        cloud.weigh();
        benchmark::DoNotOptimize(cloud.moments());
        cloud.forget_weights();
    }
    state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(mrpt_update);

void mrpt_epoch(benchmark::State& state) {
    MrptWalkers cloud;
    for (auto _ : state) {
        cloud.move();
        cloud.weigh();
        benchmark::DoNotOptimize(cloud.moments());
        cloud.resample_if_poor();
    }
    state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(mrpt_epoch);
#endif

} // namespace
