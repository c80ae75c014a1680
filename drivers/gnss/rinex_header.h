// What the header of an observation file of RINEX 3 says that the observations need.
#pragma once

#include "drivers/gnss/rinex_text.h"
#include "fusion/measurement.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace locus::gnss::rinex {

class Header {
  public:
    static constexpr std::size_t most_types = 128; ///< of observation, of one constellation

    /// A line of the header, or of those that may stand between epochs. `error`: a sentence where it cannot be used.
    void read(std::string_view line, std::string& error);

    bool ended() const { return ended_; }

    /// Codes of three letters in the order of a satellite's line; none: unknown constellation.
    const std::vector<std::string>& types(std::uint8_t constellation) const { return types_[constellation]; }

    /// Frequency number + 7, if the header tells it.
    std::optional<std::uint8_t> glonass_slot(std::uint8_t satellite) const;

    /// Of a date in the time that the file counts.
    std::optional<GpsTime> time(const CivilTime& date) const;

  private:
    enum class Count : std::uint8_t { gps, utc, beidou };

    bool ended_ = false;
    Count count_ = Count::gps;
    std::optional<std::uint8_t> continued_; ///< whose types go on in the next line
    std::array<std::vector<std::string>, 8> types_;
    std::map<std::uint8_t, std::uint8_t> slots_;

    void read_types(std::string_view line, std::string& error);
    void read_slots(std::string_view line, std::string& error);
    void read_time_system(std::string_view line, std::string& error);
};

} // namespace locus::gnss::rinex
