// Range differences at a silent listener from the packets that Loco anchors send each other. B's packet says when B
// received A's, and how far they are apart; so it says how much later than A's it was sent, in B's clock. What the
// listener's own clock shows beyond that is the difference of the ways to it:
//
//   distance(B) - distance(A) = c * ((rxB - rxA) - k * (txB_in_B - rxA_in_B + distanceAB))
//
// with k, the rate of the listener's clock against B's, from successive packets of B. The antennas' delay is in
// rxA_in_B with one sign and in distanceAB with the other, and drops out.
#pragma once

#include "drivers/uwb/loco_packets.h"
#include "fusion/measurement.h"

#include <array>
#include <cstdint>
#include <optional>

namespace locus::uwb::loco {

class DifferenceMaker {
  public:
    /// One packet heard from `sender` when the listener's 40-bit clock stood at `rx_ticks`. The difference is between
    /// the sender (b) and the anchor (a) that was heard last of those that it speaks of; numbers of anchors as they
    /// are sent. Empty: none can be told, or it is farther than any radio is heard.
    std::optional<RangeDifference> hear(std::uint8_t sender, std::uint64_t rx_ticks, const Payload& payload);

    void reset() { anchors_.fill({}); }

  private:
    struct Anchor {
        bool heard = false;
        std::uint8_t packet = 0; ///< number of its last packet
        std::uint64_t rx_ticks_in_listener = 0;
        std::uint32_t tx_ticks_in_anchor = 0;
        double rate_excess = 0;      ///< k - 1
        unsigned rates_in_a_row = 0; ///< that agreed with it; one may be wrong
    };

    static void meet(Anchor& anchor, std::uint8_t packet, std::uint64_t rx_ticks, std::uint32_t tx_ticks);
    static void take_rate(Anchor& anchor, double rate_excess, double interval_s);
    const Tdoa3::Remote* newest_known(const Tdoa3& packet, std::uint8_t sender, std::uint64_t rx_ticks) const;

    std::array<Anchor, 256> anchors_{};
};

} // namespace locus::uwb::loco
