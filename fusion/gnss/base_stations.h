// Differential corrections of code: what a base station at a known place measures beyond what the models say is
// measured by receivers nearby as well, and taken off there, satellite by satellite.
//
// The base's own clock is in all of it. It is estimated for each constellation from all its satellites (least squares,
// with the test of single points, so one satellite that is wrong at the base corrects nothing) and taken out: corrected
// and uncorrected pseudoranges of a receiver then share the receiver's clock, but for the mean of what the models leave
// at the base, which is no larger than what each uncorrected one is believed to be off.
//
// A base is asked for each epoch of a receiver with the very ephemerides that this epoch uses: words that one satellite
// has said anew never stand against old ones.
#pragma once

#include "fusion/gnss/correction.h"
#include "fusion/gnss/ephemeris_book.h"
#include "fusion/gnss/satellite_places.h"
#include "fusion/gnss/sight_from.h"
#include "fusion/gnss/signals.h"

#include <limits>
#include <vector>

namespace locus::gnss {

class BaseStations {
  public:
    /// Of more bases the one that was silent longest is forgotten.
    static constexpr std::size_t most_bases = 4;

    /// Throws as SinglePointSolver does.
    explicit BaseStations(const GnssSettings& settings);

    /// none: kept, and what was kept before has corrected a receiver.
    Exclusion hear(const GnssBaseRange& range, std::uint16_t input) noexcept;

    /// Works out the corrections for what is received at `time`, by the base that stands nearest to `near_ecef_m` of
    /// those that are not silent; empty: by any.
    void prepare(const GpsTime& time, const std::optional<Eigen::Vector3d>& near_ecef_m,
                 const EphemerisBook& ephemerides) noexcept;

    /// Of the last prepare().
    const std::optional<Correction>& find(std::uint8_t constellation, std::uint8_t satellite) const noexcept {
        return corrections_[satellite_place(constellation, satellite)];
    }

  private:
    static constexpr double never = -std::numeric_limits<double>::infinity();

    struct Base {
        Address station = no_address;
        std::uint16_t input = 0;
        std::uint64_t heard = 0; ///< when, in pseudoranges of all bases; 0: a slot not in use
        Vec3 antenna_ecef_m{};
        std::array<GnssBaseRange, satellite_places::all> ranges{}; ///< of each satellite the newest; at 0 m: none
        std::array<double, clock_count> newest_s{};                ///< of each clock; `never`: none
        double asked_s = never;                                    ///< time of its pseudoranges when last used
        Exclusion outcome = Exclusion::nothing_to_correct;
    };

    Exclusion judge(const GnssBaseRange& range) const noexcept;
    Base& base_of(const GnssBaseRange& range, std::uint16_t input) noexcept;
    Base* choose(const GpsTime& time, const std::optional<Eigen::Vector3d>& near_ecef_m) noexcept;
    double age_s(const Base& base, const GpsTime& time) const noexcept;
    void sight(const Base& base, const GpsTime& time, const EphemerisBook& ephemerides) noexcept;
    bool solve_clocks(const Base& base) noexcept;
    Exclusion correct(const Base& base, const GpsTime& time, const EphemerisBook& ephemerides) noexcept;
    void put(const Base& base, const GpsTime& time) noexcept;

    GnssSettings settings_;
    Observer observer_;
    double normal_quantile_;
    std::array<Base, most_bases> bases_{};
    std::uint64_t heard_ = 0;

    std::vector<SightFrom> sights_;   ///< of the base that is asked
    std::vector<std::size_t> places_; ///< beside them
    std::array<double, clock_count> clocks_m_{};
    std::array<int, clock_count> clock_rows_{};
    std::array<std::optional<Correction>, satellite_places::all + 1> corrections_{}; ///< that of nowhere stays empty
};

} // namespace locus::gnss
