// Messages of an RTCM 3 base station, written the way round that the decoder does not go: for tests only.
#pragma once

#include "drivers/gnss/rtcm3_frame.h"
#include "fusion/geometry/earth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace locus::test::rtcm3 {

using Bytes = std::vector<std::uint8_t>;

/// Fields one after the other, highest bit first.
class BitWriter {
  public:
    BitWriter& put(std::uint64_t value, unsigned count) {
        for (unsigned i = count; i-- > 0;) {
            if (at_++ % 8 == 0) bytes_.push_back(0);
            bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (value >> i & 1) << (7 - (at_ - 1) % 8));
        }
        return *this;
    }
    BitWriter& put_signed(std::int64_t value, unsigned count) { return put(static_cast<std::uint64_t>(value), count); }
    Bytes frame() const { return gnss::rtcm3::frame(bytes_); }

  private:
    Bytes bytes_;
    std::size_t at_ = 0;
};

/// 1005, or 1006 with a height over the mark.
inline Bytes place(unsigned number, unsigned station, const Eigen::Vector3d& antenna_ecef_m, double height_m = 0) {
    const auto tenth_mm = [&](int axis) { return std::llround(antenna_ecef_m[axis] * 1e4); };
    BitWriter bits;
    bits.put(number, 12).put(station, 12).put(0, 6).put(0b1110, 4);
    bits.put_signed(tenth_mm(0), 38).put(0, 2).put_signed(tenth_mm(1), 38).put(0, 2).put_signed(tenth_mm(2), 38);
    if (number == 1006) bits.put(static_cast<std::uint64_t>(std::llround(height_m * 1e4)), 16);
    return bits.frame();
}

/// One cell of a multiple signal message, or the L1 of 1002.
struct Cell {
    unsigned satellite = 1; ///< from 1 on
    unsigned signal = 2;    ///< number in DF395: 2 is C/A, B1I
    double pseudorange_m = 2.2e7;
    double carrier_to_noise_dbhz = 45; ///< 0: unknown
    unsigned slot = 7;                 ///< GLONASS: frequency number + 7
    bool measured = true;              ///< false: it has no fine pseudorange
};

namespace detail {

inline double milliseconds(double metres) { return metres / (1e-3 * light_mps); }

/// Rounded to what the rough range can tell, 2^-10 ms.
inline std::int64_t rough(const std::vector<Cell>& cells, unsigned satellite) {
    const auto cell = std::ranges::find(cells, satellite, &Cell::satellite);
    return std::llround(milliseconds(cell->pseudorange_m) * 1024);
}

inline std::int64_t fine(const Cell& cell, std::int64_t rough, double unit_ms) {
    return std::llround((milliseconds(cell.pseudorange_m) - static_cast<double>(rough) / 1024) / unit_ms);
}

} // namespace detail

/// `number`: 1074 to 1127. `time`: DF004 and the like, 30 bits. `cells`: by satellite, then by signal, rising.
inline Bytes msm(unsigned number, unsigned station, std::uint64_t time, const std::vector<Cell>& cells) {
    using namespace detail;
    const bool extended = number % 10 == 5 || number % 10 == 7, high = number % 10 >= 6;
    std::set<unsigned> satellites, signals;
    for (const Cell& cell : cells) satellites.insert(cell.satellite), signals.insert(cell.signal);
    BitWriter bits;
    bits.put(number, 12).put(station, 12).put(time, 30).put(0, 1 + 3 + 7 + 2 + 2 + 1 + 3);
    for (unsigned i = 1; i <= 64; ++i) bits.put(satellites.contains(i), 1);
    for (unsigned i = 1; i <= 32; ++i) bits.put(signals.contains(i), 1);
    for (const unsigned satellite : satellites)
        for (const unsigned signal : signals)
            bits.put(std::ranges::any_of(cells,
                                         [&](const Cell& c) { return c.satellite == satellite && c.signal == signal; }),
                     1);
    for (const unsigned s : satellites) bits.put(static_cast<std::uint64_t>(rough(cells, s) / 1024), 8);
    for (const unsigned s : satellites)
        if (extended) bits.put(std::ranges::find(cells, s, &Cell::satellite)->slot, 4);
    for (const unsigned s : satellites) bits.put(static_cast<std::uint64_t>(rough(cells, s) % 1024), 10);
    if (extended)
        for (std::size_t i = 0; i < satellites.size(); ++i) bits.put_signed(0, 14);
    const unsigned fine_bits = high ? 20 : 15;
    for (const Cell& c : cells)
        bits.put_signed(c.measured ? fine(c, rough(cells, c.satellite), high ? 0x1p-29 : 0x1p-24)
                                   : -(std::int64_t{1} << (fine_bits - 1)),
                        fine_bits);
    for (const Cell& c : cells) // the carrier, as if it were the code
        bits.put_signed(fine(c, rough(cells, c.satellite), high ? 0x1p-31 : 0x1p-29), high ? 24 : 22);
    for (std::size_t i = 0; i < cells.size(); ++i) bits.put(5, high ? 10 : 4);
    for (std::size_t i = 0; i < cells.size(); ++i) bits.put(0, 1);
    for (const Cell& c : cells)
        bits.put(static_cast<std::uint64_t>(std::llround(c.carrier_to_noise_dbhz * (high ? 16 : 1))), high ? 10 : 6);
    for (std::size_t i = 0; i < cells.size() && extended; ++i) bits.put_signed(0, 15);
    return bits.frame();
}

/// 1002: GPS at L1.
inline Bytes gps_l1(unsigned station, std::uint64_t time_ms, const std::vector<Cell>& cells) {
    constexpr double millisecond_m = 1e-3 * light_mps;
    BitWriter bits;
    bits.put(1002, 12).put(station, 12).put(time_ms, 30).put(0, 1).put(cells.size(), 5).put(0, 4);
    for (const Cell& c : cells) {
        const double whole = std::floor(c.pseudorange_m / millisecond_m);
        bits.put(c.satellite, 6).put(c.signal != 2, 1);
        bits.put(static_cast<std::uint64_t>(std::llround((c.pseudorange_m - whole * millisecond_m) / 0.02)), 24);
        bits.put_signed(0, 20).put(5, 7).put(static_cast<std::uint64_t>(whole), 8);
        bits.put(static_cast<std::uint64_t>(std::llround(c.carrier_to_noise_dbhz * 4)), 8);
    }
    return bits.frame();
}

/// DF416 and DF034.
inline std::uint64_t glonass_time(unsigned day, std::uint64_t ms) { return std::uint64_t{day} << 27 | ms; }

} // namespace locus::test::rtcm3
