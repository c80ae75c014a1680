#include "fusion/uwb/clock_sync/synchroniser.h"

#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::uwb {
namespace {

/// An arrival may lie this many standard deviations outside what the distance between two anchors allows.
constexpr double possible_in_sigma = 5;

std::uint64_t ticks_of(const Measurement& arrival) {
    return std::get_if<Arrival>(&arrival.observation)->rx_anchor_ticks_in_anchor;
}

/// Whether no sync packet to come can make it better.
bool is_settled(Blink& blink) {
    return std::ranges::all_of(blink.arrivals(), [](const HeardBlink& h) { return !h.time || h.time->settled; });
}

double variance_ticks2(const HeardBlink& heard) {
    return heard.time ? heard.time->time.variance_ticks2 : std::numeric_limits<double>::infinity();
}

/// nullptr when no clock is known.
HeardBlink* most_certain(Blink& blink) {
    const auto best = std::ranges::min_element(blink.arrivals(), {}, variance_ticks2);
    return best == blink.arrivals().end() || !best->time ? nullptr : &*best;
}

} // namespace

ClockSynchroniser::ClockSynchroniser(const Site& site, const ClockSyncSettings& settings, Duration longest_wait)
    : site_(site), gather_(std::min(duration_from_s(settings.gather_s), longest_wait)),
      wait_(std::min(duration_from_s(settings.wait_s), longest_wait)), clock_(settings.clock_bits),
      arrival_variance_ticks2_(std::pow(settings.arrival_sigma_m / tick_m, 2)),
      max_clock_variance_ticks2_(std::pow(settings.max_clock_sigma_m / tick_m, 2)), graph_(site, settings),
      blinks_(gather_, site.anchors.size() > 1) {}

Verdict ClockSynchroniser::hear(const ClockSync& packet, Timestamp time) noexcept {
    const auto transmitter = ClockGraph::node_of(site_, packet.transmitter);
    const auto receiver = ClockGraph::node_of(site_, packet.receiver);
    if (transmitter == ClockGraph::nobody || receiver == ClockGraph::nobody) return {Exclusion::clock_not_synchronised};
    return graph_.hear(transmitter, receiver,
                       {packet.tx_transmitter_ticks_in_transmitter, {packet.rx_receiver_ticks_in_receiver, time}});
}

Exclusion ClockSynchroniser::hear(const Measurement& arrival, const AidBook::Record& record) noexcept {
    return blinks_.keep(arrival, ClockGraph::node_of(site_, std::get_if<Arrival>(&arrival.observation)->anchor),
                        record);
}

void ClockSynchroniser::run(Timestamp tick, Output& output) noexcept {
    graph_.refresh(tick);
    blinks_.deal([&](Blink& blink) { return deal(blink, tick, output); });
}

bool ClockSynchroniser::deal(Blink& blink, Timestamp tick, Output& output) noexcept {
    const Duration age = tick - blink.time;
    if (age < gather_) return false;
    place(blink);
    if (age < wait_ && !is_settled(blink)) return false;
    compare(blink, output);
    return true;
}

/// In the order of the site, whatever the order in which they came.
void ClockSynchroniser::place(Blink& blink) const noexcept {
    std::sort(blink.arrivals().begin(), blink.arrivals().end(),
              [](const HeardBlink& a, const HeardBlink& b) { return a.anchor < b.anchor; });
    for (HeardBlink& heard : blink.arrivals())
        heard.time = graph_.root_time(heard.anchor, {ticks_of(heard.arrival), heard.arrival.time});
}

/// All against the most certain one. When that fits none of two others or more, it is itself the odd one, as a master
/// that was started anew is, and the next one is asked.
void ClockSynchroniser::compare(Blink& blink, Output& output) const noexcept {
    HeardBlink* reference = most_certain(blink);
    while (reference && fits_nobody(blink, *reference)) {
        output.judge(reference->arrival, reference->record, Exclusion::impossible_difference);
        blink.drop(*reference);
        reference = most_certain(blink);
    }
    bool compared = false;
    for (const HeardBlink& heard : blink.arrivals())
        if (&heard != reference && give(blink, reference, heard, output)) compared = true;
    if (reference)
        output.judge(reference->arrival, reference->record, compared ? Exclusion::none : Exclusion::geometry_too_few);
}

bool ClockSynchroniser::fits_nobody(Blink& blink, const HeardBlink& reference) const noexcept {
    int others = 0;
    for (const HeardBlink& heard : blink.arrivals()) {
        const auto found = &heard == &reference ? std::nullopt : difference(reference, heard);
        if (found && is_possible(*found)) return false;
        if (found) ++others;
    }
    return others > 1;
}

bool ClockSynchroniser::give(const Blink& blink, const HeardBlink* reference, const HeardBlink& heard,
                             Output& output) const noexcept {
    const auto found = reference ? difference(*reference, heard) : std::nullopt;
    if (found && is_possible(*found)) {
        output.take({blink.time, heard.arrival.sequence, heard.arrival.input, *found}, heard.record);
        return true;
    }
    output.judge(heard.arrival, heard.record,
                 found ? Exclusion::impossible_difference : Exclusion::clock_not_synchronised);
    return false;
}

/// Both arrivals in the root's clock, less one another. Empty when a clock is not known, or not certain enough.
std::optional<RangeDifference> ClockSynchroniser::difference(const HeardBlink& a, const HeardBlink& b) const noexcept {
    if (!a.time || !b.time) return std::nullopt;
    const double clock_variance_ticks2 = ClockGraph::variance_between(*a.time, *b.time);
    if (!(clock_variance_ticks2 <= max_clock_variance_ticks2_)) return std::nullopt;
    const RemoteTime &a_time = a.time->time, &b_time = b.time->time;
    const double ticks =
        static_cast<double>(clock_.between(b_time.ticks, a_time.ticks)) + (b_time.rest_ticks - a_time.rest_ticks);
    const double sigma_m = std::sqrt(clock_variance_ticks2 + 2 * arrival_variance_ticks2_) * tick_m;
    return RangeDifference{site_.anchors[a.anchor].address,
                           site_.anchors[b.anchor].address,
                           std::get_if<Arrival>(&b.arrival.observation)->tag,
                           ticks * tick_m,
                           static_cast<float>(sigma_m),
                           LineOfSight::unknown};
}

bool ClockSynchroniser::is_possible(const RangeDifference& difference) const noexcept {
    const Anchor* a = site_.find_anchor(difference.anchor_a);
    const Anchor* b = site_.find_anchor(difference.anchor_b);
    const double distance_m = (vector(b->position_site_m) - vector(a->position_site_m)).norm();
    return std::abs(difference.difference_m) <= distance_m + possible_in_sigma * double{difference.sigma_m};
}

} // namespace locus::uwb
