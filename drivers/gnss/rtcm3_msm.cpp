#include "drivers/gnss/rtcm3_msm.h"

#include "drivers/gnss/rtcm3_msm_layout.h"
#include "drivers/gnss/rtcm3_time.h"
#include "fusion/geometry/earth.h"

#include <bit>
#include <cmath>

namespace locus::gnss::rtcm3 {
namespace {

/// The numbers (from 1 on) of the bits that are set, of which there are at most 64.
struct Numbers {
    std::array<std::uint8_t, 64> items{};
    std::size_t count = 0;

    Numbers(std::uint64_t mask, unsigned width) {
        for (unsigned i = 0; i < width; ++i)
            if (mask >> (width - 1 - i) & 1) items[count++] = static_cast<std::uint8_t>(i + 1);
    }
};

struct Satellite {
    double rough_ms = 0; ///< 0: not measured
    std::uint8_t slot = 7;
};

using Satellites = std::array<Satellite, 64>;

Satellites take_satellites(Bits& bits, std::size_t count, const Layout& layout, bool glonass) {
    constexpr std::uint64_t no_range = 255, highest_slot = 13;
    Satellites all;
    for (std::size_t i = 0; i < count; ++i)
        if (const auto whole_ms = bits.take(8); whole_ms != no_range) all[i].rough_ms = static_cast<double>(whole_ms);
    for (std::size_t i = 0; i < count && layout.extended; ++i)
        if (const auto slot = bits.take(4); glonass && slot <= highest_slot)
            all[i].slot = static_cast<std::uint8_t>(slot);
    for (std::size_t i = 0; i < count; ++i) {
        const auto part = bits.take(10);
        if (all[i].rough_ms > 0) all[i].rough_ms += static_cast<double>(part) * 0x1p-10;
    }
    if (layout.extended) bits.skip(14 * count);
    return all;
}

/// The fine pseudoranges and strengths, which stand apart: one reader for each.
class Cells {
  public:
    Cells(const Bits& at, std::size_t count, const Layout& layout) : layout_{layout}, fine_{at}, strength_{at} {
        strength_.skip(count * (layout.fine + layout.between));
    }

    /// NaN: not measured.
    double take_fine_ms() {
        const std::int64_t fine = fine_.take_signed(layout_.fine);
        const bool measured = fine != -(std::int64_t{1} << (layout_.fine - 1));
        return measured ? static_cast<double>(fine) * layout_.fine_unit_ms : unknown_d;
    }
    float take_strength_dbhz() {
        const auto strength = strength_.take(layout_.strength);
        return strength != 0 ? static_cast<float>(strength) * layout_.strength_unit_dbhz : unknown_f;
    }

  private:
    Layout layout_;
    Bits fine_, strength_;
};

std::optional<double> take_time(Bits& bits, std::uint8_t constellation) {
    if (constellation == constellation::glonass) {
        const auto day = bits.take(3);
        return gps_second_of_glonass(day, bits.take(27));
    }
    const auto ms = bits.take(30);
    return constellation == constellation::beidou ? gps_second_of_beidou(ms) : gps_second(ms);
}

/// The masks: which pairs of satellite and signal were measured.
struct Masks {
    Numbers satellites, signals;
    std::uint64_t cells = 0; ///< one bit a pair, satellite by satellite, the first pair highest

    std::size_t pairs() const { return satellites.count * signals.count; }
    bool measured(std::size_t pair) const { return cells >> (pairs() - 1 - pair) & 1; }
    std::size_t cell_count() const { return static_cast<std::size_t>(std::popcount(cells)); }
};

/// Empty when they do not fit the message.
std::optional<Masks> take_masks(Bits& bits) {
    constexpr std::size_t most_pairs = 64;
    const std::uint64_t satellites = bits.take(64);
    Masks masks{Numbers{satellites, 64}, Numbers{bits.take(32), 32}};
    if (masks.pairs() > most_pairs || bits.left() < masks.pairs()) return std::nullopt;
    if (masks.pairs() > 0) masks.cells = bits.take(masks.pairs());
    return masks;
}

void add(Epoch& epoch, const Signal& signal) {
    const bool again = epoch.count > 0 && epoch.signals[epoch.count - 1].satellite == signal.satellite;
    if (!again && std::isfinite(signal.pseudorange_m)) epoch.signals[epoch.count++] = signal;
}

void take_signals(Bits& bits, const Masks& masks, const Layout& layout, Epoch& epoch) {
    const bool glonass = epoch.constellation == constellation::glonass;
    const Satellites rough = take_satellites(bits, masks.satellites.count, layout, glonass);
    Cells fine{bits, masks.cell_count(), layout};
    for (std::size_t pair = 0; pair < masks.pairs(); ++pair) {
        if (!masks.measured(pair)) continue;
        const double fine_ms = fine.take_fine_ms();
        const float strength_dbhz = fine.take_strength_dbhz();
        const std::size_t at = pair / masks.signals.count;
        const std::uint8_t number = masks.satellites.items[at];
        const auto signal = signal_of(epoch.constellation, number, masks.signals.items[pair % masks.signals.count]);
        if (!signal || rough[at].rough_ms <= 0) continue;
        const double pseudorange_m = 1e-3 * light_mps * (rough[at].rough_ms + fine_ms);
        add(epoch, {pseudorange_m, strength_dbhz, number, signal.value(), rough[at].slot});
    }
}

} // namespace

bool is_msm(unsigned number) { return constellation_of(number) && number % 10 >= 4 && number % 10 <= 7; }

Reading parse_msm(wire::Bytes message) {
    constexpr std::size_t head_bits = 169;
    Bits bits{message};
    if (bits.left() < head_bits) return {{}, true};
    const auto number = static_cast<unsigned>(bits.take(12));
    const Layout layout = layout_of(number);
    Epoch epoch;
    epoch.constellation = constellation_of(number).value_or(0);
    epoch.station = static_cast<std::uint16_t>(bits.take(12));
    const auto time_s = take_time(bits, epoch.constellation);
    bits.skip(1 + 3 + 7 + 2 + 2 + 1 + 3); // more to come, issue, reserved, clock steering, external clock, smoothing
    const auto masks = take_masks(bits);
    if (!masks) return {{}, true};
    const std::size_t satellite_bits = masks->satellites.count * layout.satellite_bits();
    if (bits.left() < satellite_bits + masks->cell_count() * layout.cell_bits()) return {{}, true};
    if (!time_s) return {};
    epoch.time_s_in_gps_week = time_s.value();
    take_signals(bits, *masks, layout, epoch);
    return {epoch, false};
}

} // namespace locus::gnss::rtcm3
