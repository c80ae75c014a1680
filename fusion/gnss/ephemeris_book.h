// What all satellites have said of themselves, heard by whichever receiver: of each the two newest ephemerides, because
// the one before goes on for half an hour and more, and the ionosphere of the day.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/gnss/atmosphere.h"
#include "fusion/gnss/ephemeris_collector.h"
#include "fusion/gnss/satellite_places.h"
#include "fusion/gnss/settings.h"

#include <array>
#include <optional>

namespace locus::gnss {

class EphemerisBook {
  public:
    explicit EphemerisBook(const GnssSettings& settings)
        : max_age_s_{settings.max_ephemeris_age_s}, max_glonass_age_s_{settings.max_glonass_age_s} {}

    /// `now`: GPS time, give or take some hours.
    void hear(const GnssNavigation& words, const GpsTime& now) noexcept;

    /// The ephemeris to use for what was received at `time`, or why there is none.
    struct Found {
        const Ephemeris* ephemeris;
        Exclusion reason;
    };
    Found find(std::uint8_t constellation, std::uint8_t satellite, const GpsTime& time) const noexcept;

    /// Empty: nobody told yet.
    const std::optional<Klobuchar>& ionosphere() const noexcept { return ionosphere_; }

  private:
    struct Said {
        std::optional<Ephemeris> newest, before;
    };

    void hear_ionosphere(const GnssNavigation& words) noexcept;
    bool is_in_time(const Ephemeris& ephemeris, const GpsTime& time) const noexcept;

    double max_age_s_, max_glonass_age_s_;
    EphemerisCollector collector_;
    std::array<Said, satellite_places::all> said_{};
    std::optional<Klobuchar> ionosphere_;
};

} // namespace locus::gnss
