// Navigation files of RINEX 2 and 3 (RINEX 2.11, tables A3, A4 and A11; RINEX 3.05, tables A5 to A14), line by line,
// into ephemerides, and the ionosphere of GPS that their header tells.
#pragma once

#include "drivers/gnss/rinex_text.h"
#include "fusion/gnss/atmosphere.h"
#include "fusion/gnss/ephemeris_collector.h"

#include <vector>

namespace locus::gnss::rinex {

/// An ephemeris, and when it was broadcast: as the file says, or where it does not, two hours before its reference time
/// (GPS, QZSS) or at it.
struct NavigationRecord {
    Ephemeris ephemeris;
    GpsTime sent;
    int leap_s = 0; ///< GPS time less UTC then
};

class Navigation {
  public:
    /// A line without its end. A record that it completes is returned by the line after it: the next record's first.
    /// `error` stays empty unless the line, or the record before it, cannot be read.
    std::optional<NavigationRecord> read(std::string_view line, std::string& error);
    /// The last record.
    std::optional<NavigationRecord> finish(std::string& error);

    /// As the header says, which stands before the first record; empty where it says nothing of GPS.
    std::optional<Klobuchar> ionosphere() const;

    /// Records of what is not read: SBAS, NavIC, Galileo's F/NAV.
    std::uint64_t passed_over() const { return passed_over_; }

  private:
    static constexpr std::size_t most_values = 48;

    Kind kind_;
    bool begun_ = false, header_ended_ = false, open_ = false;
    char system_ = 0;
    std::string head_; ///< satellite and reference time
    std::vector<std::optional<double>> values_;
    std::uint64_t passed_over_ = 0;
    Klobuchar ionosphere_;
    bool has_alpha_ = false, has_beta_ = false;

    std::size_t shift() const { return kind_.version < 3 ? 3 : 4; }
    std::string_view head_of(std::string_view line) const;
    void read_header(std::string_view line, std::string& error);
    void read_ionosphere(std::string_view line, std::string& error);
    void begin_record(std::string_view line, std::string& error);
    void read_values(std::string_view line, std::size_t begin, std::string& error);
};

} // namespace locus::gnss::rinex
