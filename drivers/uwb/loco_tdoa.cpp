#include "drivers/uwb/loco_tdoa.h"

#include "drivers/uwb/limits.h"
#include "fusion/uwb/ticks.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb::loco {
namespace {

constexpr WrappingClock listener{40}, anchors{32};

/// Anchors' stamps tell intervals up to 67 ms, by anyone's clock.
constexpr std::int64_t longest_interval_ticks = anchors.period_ticks() - anchors.period_ticks() / 100;
/// Crystals are within 20 ppm (DW1000 data sheet, 5.1), two of them within twice that; the rest is for cold ones.
constexpr double largest_rate_excess = 60e-6;
/// Between packets rates change by less, also where the way suddenly is a metre longer: a stamp was wrong, or the
/// anchor began again.
constexpr double largest_rate_step = 3e-7;
constexpr unsigned enough_rates = 2;
/// Rates move over seconds (temperature), stamps are noisy to 1e-8 over 20 ms: smoothed over this.
constexpr double smoothing_s = 0.1;

/// Both kinds of packet as the later one says it.
Tdoa3 as_tdoa3(const Tdoa2& packet, std::uint8_t sender) {
    Tdoa3 other{packet.packets[sender], packet.ticks_in_sender[sender], {}, 0};
    for (std::uint8_t i = 0; i < anchors_of_tdoa2; ++i)
        if (i != sender)
            other.remotes[other.remote_count++] = {i, packet.packets[i], packet.ticks_in_sender[i],
                                                   packet.distance_ticks[i]};
    return other;
}

std::optional<Tdoa3> stamps_of(const Payload& payload, std::uint8_t sender) {
    if (const auto* packet = std::get_if<Tdoa3>(&payload)) return *packet;
    const auto* packet = std::get_if<Tdoa2>(&payload);
    if (packet == nullptr || sender >= anchors_of_tdoa2) return std::nullopt;
    return as_tdoa3(*packet, sender);
}

} // namespace

std::optional<RangeDifference> DifferenceMaker::hear(std::uint8_t sender, std::uint64_t rx_ticks,
                                                     const Payload& payload) {
    const auto packet = stamps_of(payload, sender);
    if (!packet) return std::nullopt;
    Anchor& b = anchors_[sender];
    meet(b, packet->packet, rx_ticks, packet->tx_ticks_in_sender);
    const Tdoa3::Remote* remote = newest_known(*packet, sender, rx_ticks);
    if (remote == nullptr || b.rates_in_a_row < enough_rates) return std::nullopt;

    const std::int64_t heard_apart = listener.since(rx_ticks, anchors_[remote->anchor].rx_ticks_in_listener);
    const std::int64_t sent_apart_in_b =
        anchors.since(packet->tx_ticks_in_sender, remote->rx_ticks_in_sender) + remote->distance_ticks;
    const double difference_ticks =
        static_cast<double>(heard_apart - sent_apart_in_b) - b.rate_excess * static_cast<double>(sent_apart_in_b);
    RangeDifference difference;
    difference.anchor_a = address(remote->anchor);
    difference.anchor_b = address(sender);
    difference.difference_m = difference_ticks * tick_m;
    if (std::abs(difference.difference_m) > farthest_dw1000_m) return std::nullopt;
    return difference;
}

void DifferenceMaker::meet(Anchor& anchor, std::uint8_t packet, std::uint64_t rx_ticks, std::uint32_t tx_ticks) {
    const std::int64_t received = listener.since(rx_ticks, anchor.rx_ticks_in_listener);
    const std::int64_t sent = anchors.since(tx_ticks, anchor.tx_ticks_in_anchor);
    if (anchor.heard && sent > 0 && received < longest_interval_ticks)
        take_rate(anchor, static_cast<double>(received - sent) / static_cast<double>(sent),
                  static_cast<double>(received) * tick_s);
    anchor.heard = true;
    anchor.packet = packet;
    anchor.rx_ticks_in_listener = rx_ticks;
    anchor.tx_ticks_in_anchor = tx_ticks;
}

void DifferenceMaker::take_rate(Anchor& anchor, double rate_excess, double interval_s) {
    if (std::abs(rate_excess) > largest_rate_excess) return void(anchor.rates_in_a_row = 0);
    const double step = rate_excess - anchor.rate_excess;
    const bool agrees = anchor.rates_in_a_row > 0 && std::abs(step) < largest_rate_step;
    anchor.rate_excess = agrees ? anchor.rate_excess + step * interval_s / (smoothing_s + interval_s) : rate_excess;
    anchor.rates_in_a_row = agrees ? anchor.rates_in_a_row + 1 : 1;
}

const Tdoa3::Remote* DifferenceMaker::newest_known(const Tdoa3& packet, std::uint8_t sender,
                                                   std::uint64_t rx_ticks) const {
    const Tdoa3::Remote* newest = nullptr;
    std::int64_t least = longest_interval_ticks;
    for (std::size_t i = 0; i < packet.remote_count; ++i) {
        const Tdoa3::Remote& remote = packet.remotes[i];
        const Anchor& anchor = anchors_[remote.anchor];
        const std::int64_t ago = listener.since(rx_ticks, anchor.rx_ticks_in_listener);
        const bool same_packet = anchor.heard && anchor.packet == remote.packet && remote.anchor != sender;
        if (!same_packet || remote.distance_ticks == 0 || ago >= least) continue;
        least = ago;
        newest = &remote;
    }
    return newest;
}

} // namespace locus::uwb::loco
