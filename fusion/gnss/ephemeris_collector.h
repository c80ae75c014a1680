// Broadcast words, as they come, into ephemerides: one is complete when the last of its parts came, in any order.
#pragma once

#include "fusion/gnss/ephemeris.h"
#include "fusion/gnss/message_bits.h"

#include <optional>
#include <span>
#include <utility>
#include <variant>

namespace locus::gnss {

using Ephemeris = std::variant<KeplerEphemeris, GlonassEphemeris>;

/// What is read: GPS L1 C/A, QZSS L1 C/A (LNAV), Galileo E1-B and E5b-I (I/NAV), BeiDou B1I, B2I, B3I (D1, D2), GLONASS
/// L1 and L2. All memory is inside; about 100 kB.
class EphemerisCollector {
  public:
    /// The ephemeris that these words made complete, also when it is the same as before. `now`: GPS time, give or take
    /// some hours; of it comes what the satellites do not tell in full (week, day). Words of other messages and damaged
    /// ones are passed over.
    std::optional<Ephemeris> add(const GnssNavigation& from, const GpsTime& now) noexcept;

    /// GPS time less UTC, for GLONASS; receivers tell it.
    void set_leap_seconds(int leap_s) noexcept { leap_s_ = leap_s; }

  private:
    static constexpr std::size_t gps_satellites = 32, qzss_satellites = 10, galileo_satellites = 36;
    static constexpr std::size_t beidou_satellites = 63, glonass_satellites = 32;
    static constexpr std::size_t geostationary_satellites = 10;

    template <std::size_t count>
    struct Parts {
        std::array<MessageBits, count> parts{};
        unsigned have = 0;

        bool put(unsigned number, const MessageBits& bits) {
            if (number < 1 || number > count) return false;
            parts[number - 1] = bits;
            have |= 1u << (number - 1);
            return have == (1u << count) - 1;
        }
    };
    struct GlonassParts : Parts<4> {
        std::uint32_t frame = 0; ///< which the receiver counted
    };

    using Words = std::span<const std::uint32_t>;
    std::optional<Ephemeris> lnav(Parts<3>& parts, const GnssNavigation& from, Words words, int week) noexcept;
    std::optional<Ephemeris> inav(Parts<5>& parts, Words words, int week) noexcept;
    std::optional<Ephemeris> d1(Parts<3>& parts, const GnssNavigation& from, Words words) noexcept;
    std::optional<Ephemeris> d2(Parts<10>& parts, const GnssNavigation& from, Words words) noexcept;
    std::optional<Ephemeris> glonass(GlonassParts& parts, const GnssNavigation& from, Words words,
                                     const GpsTime& now) const noexcept;

    int leap_s_ = 18; ///< since 2017
    std::array<Parts<3>, gps_satellites> gps_{};
    std::array<Parts<3>, qzss_satellites> qzss_{};
    std::array<Parts<5>, galileo_satellites> galileo_{};
    std::array<Parts<3>, beidou_satellites> beidou_{};
    std::array<Parts<10>, geostationary_satellites> geostationary_{};
    std::array<GlonassParts, glonass_satellites> glonass_{};
};

} // namespace locus::gnss
