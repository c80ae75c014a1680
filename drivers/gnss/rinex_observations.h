// Observation files of RINEX 3.0x, line by line, into GnssRaw (RINEX 3.05, table A2 and A3). Measured is what receivers
// of u-blox number (rinex_signal.h); times are GPS time.
#pragma once

#include "drivers/decoder.h"
#include "drivers/gnss/rinex_header.h"
#include "drivers/gnss/rinex_satellite_line.h"

namespace locus::gnss::rinex {

class Observations {
  public:
    struct Counts {
        std::uint64_t epochs = 0;
        std::uint64_t signals = 0;           ///< given
        std::uint64_t without_range = 0;     ///< of a signal there is something, but no pseudorange
        std::uint64_t without_number = 0;    ///< u-blox has no number for the signal
        std::uint64_t without_frequency = 0; ///< GLONASS, and neither header nor navigation file tells the channel
        std::uint64_t other_satellites = 0;  ///< NavIC
    };

    explicit Observations(Address tag) : tag_{tag} {}

    /// A line without its end; what it measured goes to `sink`. `error` stays empty unless it cannot be read.
    void read(std::string_view line, MeasurementSink& sink, std::string& error);
    /// What is missing at the end of the file.
    void finish(std::string& error) const;

    /// The channels (number + 7) of GLONASS satellites that a navigation file tells; the header's come first.
    void set_glonass_slots(std::map<std::uint8_t, std::uint8_t> slots) { slots_ = std::move(slots); }

    const Counts& counts() const { return counts_; }

  private:
    /// The carrier of one signal, as long as it holds.
    struct Lock {
        GpsTime since;
        std::uint64_t epoch = 0; ///< the last that had it
        bool half_cycle = false; ///< it was in doubt then
    };

    Address tag_;
    Header header_;
    std::map<std::uint8_t, std::uint8_t> slots_;
    std::map<std::uint32_t, Lock> locks_;
    Counts counts_;
    GpsTime time_;
    int satellites_left_ = 0, passed_over_ = 0, header_lines_ = 0;

    void read_epoch(std::string_view line, std::string& error);
    void begin_epoch(const GpsTime& time, int flag, int count);
    void read_satellite(std::string_view line, MeasurementSink& sink, std::string& error);
    void give(const Satellite& satellite, const std::vector<Signal>& signals, MeasurementSink& sink);
    bool give(const GnssRaw& raw, MeasurementSink& sink);
    std::optional<std::uint8_t> slot_of(const Satellite& satellite) const;
    float lock_s(const GnssRaw& raw, const Signal& signal);
};

} // namespace locus::gnss::rinex
