// Signal strengths with their times, and where their radios were: gathered into a map.
#pragma once

#include "fusion/radio/survey.h"
#include "tools/evaluate/track.h"

#include <cstdint>
#include <optional>
#include <string>

namespace locus::survey {

/// What a map's file says of itself.
struct Heading {
    std::string site, date, device;
};

struct Collected {
    radio::RadioMap map;
    std::uint64_t readings = 0;  ///< that went into it
    std::uint64_t unplaced = 0;  ///< heard when nobody knew where
    std::uint64_t bad_lines = 0; ///< of the recordings
};

/// The place at a time between two poses at most a second apart; empty elsewhere.
std::optional<Vec3> place_at(const evaluate::Track& track, double time_s);

class Collector {
  public:
    /// `stood_site_m`: where all was heard; empty: where the tracks say.
    Collector(double cell_m, const std::optional<Vec3>& stood_site_m) : survey_(cell_m), stood_site_m_(stood_site_m) {}

    void add(const radio::Reading& reading, double time_s, const evaluate::Track& track);
    Collected finish(const Heading& heading);

  private:
    radio::Survey survey_;
    std::optional<Vec3> stood_site_m_;
    Collected collected_;
};

} // namespace locus::survey
