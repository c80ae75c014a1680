// A GNSS stream decoded whole: its measurements, its refusals, and the ephemerides that its words make.
#pragma once

#include "drivers/decoder.h"
#include "fusion/gnss/ephemeris_collector.h"

#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace locus::gnss {

struct Replay : MeasurementSink {
    std::vector<GnssFix> fixes;
    std::vector<GnssRaw> raws;
    std::size_t epochs = 0, navigations = 0, frames = 0;
    std::array<std::size_t, refusal_count> refused{};
    std::map<std::string, Ephemeris> ephemerides; ///< by name as RINEX has it, the last one of each

    void accept(Timestamp, const Observation& observation) override {
        if (const auto* fix = std::get_if<GnssFix>(&observation)) fixes.push_back(*fix);
        if (const auto* raw = std::get_if<GnssRaw>(&observation)) add(*raw);
        if (const auto* navigation = std::get_if<GnssNavigation>(&observation)) add(*navigation);
    }
    void frame(std::span<const std::uint8_t> /*bytes*/) override { ++frames; }
    void refuse(Refusal reason) override { ++refused[static_cast<std::size_t>(reason)]; }

    GpsTime now{2381, 408600}; ///< of the last epoch

  private:
    EphemerisCollector collector_;

    void add(const GnssRaw& raw) {
        const GpsTime time{raw.gps_week, raw.receiver_time_s_in_gps_week};
        epochs += raws.empty() || time - now != 0;
        now = time;
        raws.push_back(raw);
    }
    void add(const GnssNavigation& navigation) {
        ++navigations;
        const auto ephemeris = collector_.add(navigation, now);
        if (!ephemeris) return;
        static const std::string letters = "GSECIJR";
        std::string name{letters[navigation.constellation], '0', '0'};
        name[1] = static_cast<char>('0' + navigation.satellite / 10);
        name[2] = static_cast<char>('0' + navigation.satellite % 10);
        ephemerides.insert_or_assign(name, *ephemeris);
    }
};

template <class Settings>
void replay(std::unique_ptr<Decoder> (*make)(const void*), const Settings& settings,
            std::span<const std::uint8_t> bytes, Replay& sink) {
    Packet packet;
    packet.data = bytes;
    make(&settings)->decode(packet, sink);
}

} // namespace locus::gnss
