#include "drivers/gnss/rinex_observations.h"

#include "drivers/gnss/gps_timestamp.h"
#include "drivers/gnss/rinex_signal.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace locus::gnss::rinex {
namespace {

constexpr int most_satellites = 999; // I3
constexpr double farthest_m = 1e8;   // twice the way to a geostationary satellite

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The flag behind the time of an epoch.
enum EpochFlag : int { good = 0, power_failed = 1, new_site = 3, header_follows = 4, slips = 6 };

GnssRaw raw_of(const Satellite& satellite, const Signal& signal, const GpsTime& time) {
    GnssRaw raw;
    raw.receiver_time_s_in_gps_week = time.second;
    raw.gps_week = static_cast<std::uint16_t>(time.week);
    raw.pseudorange_m = signal.range_m.value_or(0);
    raw.carrier_cycles = signal.carrier_cycles.value_or(0);
    raw.doppler_hz = signal.doppler_hz.value_or(0);
    raw.carrier_to_noise_dbhz = static_cast<float>(signal.strength_dbhz.value_or(unknown));
    raw.constellation = satellite.constellation;
    raw.satellite = satellite.number;
    return raw;
}

} // namespace

void Observations::read(std::string_view line, MeasurementSink& sink, std::string& error) {
    if (line.size() > longest_line) error = "it is longer than any line of RINEX";
    if (line.empty() || !error.empty()) return;
    if (!header_.ended()) return header_.read(line, error);
    if (line[0] == '>') return read_epoch(line, error);
    if (std::exchange(header_lines_, std::max(0, header_lines_ - 1)) > 0) return header_.read(line, error);
    if (std::exchange(passed_over_, std::max(0, passed_over_ - 1)) > 0) return;
    if (satellites_left_ == 0) {
        error = "there should stand the time of an epoch, which begins with '>'";
        return;
    }
    --satellites_left_;
    read_satellite(line, sink, error);
}

void Observations::finish(std::string& error) const {
    if (!header_.ended()) error = "the file ends inside its header";
    if (satellites_left_ > 0)
        error = fmt::format("the last epoch has {} satellites less than it says", satellites_left_);
}

/// "> 2019  4 28 12 44 33.9970000  0  8"
void Observations::read_epoch(std::string_view line, std::string& error) {
    const int missing = std::exchange(satellites_left_, 0);
    header_lines_ = passed_over_ = 0;
    if (missing > 0) error = fmt::format("the epoch before it has {} satellites less than it says", missing);
    const auto flag = whole(columns(line, 29, 3));
    const auto count = whole(columns(line, 32, 3));
    if (!flag || !count || *flag < good || *flag > slips || *count < 0 || *count > most_satellites) {
        error = "the flag and the number of satellites of the epoch cannot be read";
        return;
    }
    if (*flag == slips)
        passed_over_ = *count;
    else if (*flag > power_failed)
        header_lines_ = *count;
    if (*flag > power_failed) return;
    const auto when = date(columns(line, 1, 28));
    const auto time = when ? header_.time(*when) : std::nullopt;
    if (time)
        begin_epoch(*time, *flag, *count);
    else {
        error = "the time of the epoch cannot be read";
        passed_over_ = *count;
    }
}

void Observations::begin_epoch(const GpsTime& time, int flag, int count) {
    if (flag == power_failed) locks_.clear();
    time_ = time;
    satellites_left_ = count;
    ++counts_.epochs;
}

std::optional<std::uint8_t> Observations::slot_of(const Satellite& satellite) const {
    if (satellite.constellation != constellation::glonass) return 0;
    if (const auto slot = header_.glonass_slot(satellite.number)) return slot;
    const auto found = slots_.find(satellite.number);
    return found == slots_.end() ? std::nullopt : std::optional{found->second};
}

void Observations::read_satellite(std::string_view line, MeasurementSink& sink, std::string& error) {
    if (!constellation_of(line[0])) {
        if (line[0] == 'I')
            ++counts_.other_satellites;
        else
            error = "it begins with no satellite such as G05";
        return;
    }
    const auto which = satellite(columns(line, 0, 3));
    if (!which) {
        error = fmt::format("there is no satellite '{}'", columns(line, 0, 3));
        return;
    }
    const auto& types = header_.types(which->constellation);
    if (types.empty()) error = fmt::format("the header does not say what is measured of '{}'", line[0]);
    const auto signals = signals_of(line, types, error);
    if (!error.empty()) return;
    give(*which, signals, sink);
}

/// Of two codes with one number (pilot, and pilot with data) the first is given.
void Observations::give(const Satellite& satellite, const std::vector<Signal>& signals, MeasurementSink& sink) {
    const auto slot = slot_of(satellite);
    std::uint32_t given = 0;
    for (const Signal& signal : signals) {
        const auto number = signal_of(satellite.constellation, satellite.number, signal.code);
        if (!number || !slot) {
            ++(number ? counts_.without_frequency : counts_.without_number);
            continue;
        }
        if (given >> *number & 1) continue;
        GnssRaw raw = raw_of(satellite, signal, time_);
        raw.tag = tag_;
        raw.signal = *number;
        raw.glonass_slot = *slot;
        if (signal.carrier_cycles) raw.lock_s = lock_s(raw, signal);
        if (give(raw, sink)) given |= 1u << *number;
    }
}

bool Observations::give(const GnssRaw& raw, MeasurementSink& sink) {
    if (raw.pseudorange_m == 0) {
        ++counts_.without_range;
        return false;
    }
    if (raw.pseudorange_m < 0 || raw.pseudorange_m > farthest_m) {
        sink.refuse(Refusal::out_of_range);
        return false;
    }
    sink.accept(timestamp(time_), raw);
    ++counts_.signals;
    return true;
}

/// Half a cycle that is in doubt is no slip while the doubt stays; where the doubt begins or ends the lock begins anew.
float Observations::lock_s(const GnssRaw& raw, const Signal& signal) {
    const std::uint32_t key = raw.constellation << 16u | raw.satellite << 8u | raw.signal;
    const auto [place, fresh] = locks_.try_emplace(key, Lock{time_, counts_.epochs, false});
    Lock& lock = place->second;
    const bool settled = std::exchange(lock.half_cycle, signal.half_cycle) == signal.half_cycle;
    if (signal.slipped || !settled || fresh || lock.epoch + 1 != counts_.epochs) lock.since = time_;
    lock.epoch = counts_.epochs;
    return static_cast<float>(time_ - lock.since);
}

} // namespace locus::gnss::rinex
