// What a whole scan says that no single reading does: who is silent, where the cloud begins, whether it is lost.
#include "fusion/estimators/radio_particles.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// Fewer leave a ring or a line, where a cloud may wait for more.
constexpr std::size_t beacons_to_start = 3;
/// By chance one reading in twenty is odd; only where twice as many are is it worth looking over the whole floor.
constexpr double odd_share = 0.1;

} // namespace

void RadioParticles::end_scan(Timestamp time) noexcept {
    gather();
    if (state_.missing != Missing::nothing) {
        start(time);
    } else {
        walk_.advance(time);
        start_again_if_lost(time);
        weigh_silence();
    }
    for (Beacon& beacon : state_.beacons) {
        beacon.sum_dbm = 0;
        beacon.count = 0;
    }
    state_.odd = state_.heard = 0;
    state_.scan_begin = time;
}

/// Within the memory set aside at construction: a beacon is there once.
void RadioParticles::gather() noexcept {
    readings_.clear();
    for (std::size_t i = 0; i < state_.beacons.size(); ++i)
        if (const Beacon& beacon = state_.beacons[i]; beacon.count > 0)
            readings_.push_back({i, beacon.mean_dbm(), beacon.offset_db, beacon.offset_variance_db2});
}

void RadioParticles::start(Timestamp time) noexcept {
    if (readings_.size() < std::min(beacons_to_start, state_.beacons.size())) {
        state_.missing = Missing::anchors;
        return;
    }
    put_where_radios_say(time);
}

void RadioParticles::put_where_radios_say(Timestamp time) noexcept {
    posterior_.solve(grid(), readings_);
    const radio::FloorCells& cells = grid().cells();
    walk_.particles().scatter(
        posterior_.weights(),
        [&](std::size_t index) { return Eigen::Vector2d(cells.place_site_m(index) - walk_.origin_site_m()); },
        cells.cell_m, settings_.speed_sigma_mps);
    walk_.begin_anew(time);
    state_.missing = Missing::nothing;
    state_.doubt = 0;
}

/// Page's test (1954): the scans' likelihood ratio of "anywhere on the floor" against the cloud, never below one,
/// gathers until chance can no longer explain it. Whom a camera sees is not lost, however odd his radio.
void RadioParticles::start_again_if_lost(Timestamp time) noexcept {
    const bool is_odd = state_.odd > odd_share * state_.heard;
    if (!is_odd || is_seen(time)) {
        state_.doubt = 0;
        return;
    }
    const double anywhere = posterior_.solve(grid(), readings_).log_mean_likelihood;
    const Eigen::Vector2f origin = walk_.origin_site_m().cast<float>();
    constexpr double most = 50; // beyond it the sum would not change
    const double ratio = cloud().mean_of([&](float x, float y) {
        const double log = radio::log_likelihood(grid(), readings_, posterior_.noise(), x + origin.x(), y + origin.y());
        return std::exp(std::min(most, log - anywhere));
    });
    state_.doubt = std::max(0.0, state_.doubt - double{scan_share()} * std::log(std::max(ratio, 1e-30)));
    if (state_.doubt < doubt_limit_) return;
    ++state_.reset_count;
    put_where_radios_say(time);
}

/// Of what a scan says, that the one before did not.
float RadioParticles::scan_share() const noexcept {
    return static_cast<float>(settings_.scan_s / std::max(settings_.scan_s, settings_.held_error_time_s));
}

/// Who could be heard and is not says as much as who is (a censored reading). Only as much of it counts as changes
/// between scans.
void RadioParticles::weigh_silence() noexcept {
    const float share = scan_share();
    const Eigen::Vector2f origin = walk_.origin_site_m().cast<float>();
    walk_.particles().weigh_places([&](float x, float y) {
        float sum = grid().silence_of_all(x + origin.x(), y + origin.y());
        for (const radio::IndexedReading& reading : readings_)
            sum -= grid().silence(reading.beacon, x + origin.x(), y + origin.y());
        return share * sum;
    });
    walk_.settle();
}

} // namespace locus
