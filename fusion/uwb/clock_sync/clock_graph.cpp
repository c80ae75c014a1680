#include "fusion/uwb/clock_sync/clock_graph.h"

#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::uwb {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();
constexpr Duration refresh_interval = duration_from_s(0.5);
/// A transmitter unheard for this long gives its place to another.
constexpr double silent_s = 10;

} // namespace

ClockGraph::Node ClockGraph::node_of(const Site& site, Address address) noexcept {
    const Anchor* anchor = site.find_anchor(address);
    return anchor ? static_cast<Node>(anchor - site.anchors.data()) : nobody;
}

ClockGraph::ClockGraph(const Site& site, const ClockSyncSettings& settings)
    : site_(site), master_(node_of(site, settings.master)),
      max_variance_ticks2_(std::pow(settings.max_clock_sigma_m / tick_m, 2)),
      slots_(site.anchors.size() * links_per_receiver,
             Slot{nobody, 0, ClockLink{CrystalModel{settings}, WrappingClock{settings.clock_bits}}}),
      weights_(slots_.size(), unreached), costs_(site.anchors.size(), unreached),
      ways_(site.anchors.size(), static_cast<std::uint32_t>(slots_.size())), heard_by_(site.anchors.size()) {}

ClockGraph::Slot* ClockGraph::slot_for(Node transmitter, Node receiver, Timestamp host) noexcept {
    const auto begin = slots_.begin() + static_cast<std::ptrdiff_t>(receiver * links_per_receiver);
    const auto end = begin + static_cast<std::ptrdiff_t>(links_per_receiver);
    const auto mine = std::find_if(begin, end, [&](const Slot& slot) { return slot.transmitter == transmitter; });
    if (mine != end) return &*mine;
    const auto oldest = std::min_element(
        begin, end, [](const Slot& a, const Slot& b) { return a.link.last_host() < b.link.last_host(); });
    const bool is_free = oldest->transmitter == nobody || to_s(host) - to_s(oldest->link.last_host()) > silent_s;
    if (!is_free) return nullptr;
    open(*oldest, transmitter, receiver);
    return &*oldest;
}

void ClockGraph::open(Slot& slot, Node transmitter, Node receiver) noexcept {
    const Anchor &from = site_.anchors[transmitter], &to = site_.anchors[receiver];
    const double distance_m = (vector(to.position_site_m) - vector(from.position_site_m)).norm();
    slot.transmitter = transmitter;
    slot.lead_ticks = (distance_m + from.antenna_delay_m) / tick_m;
    slot.link.clear();
    stale_ = true;
}

Verdict ClockGraph::hear(Node transmitter, Node receiver, const SyncStamps& stamps) noexcept {
    Slot* slot = transmitter == receiver ? nullptr : slot_for(transmitter, receiver, stamps.received.host);
    if (!slot) return {Exclusion::clock_not_synchronised};
    const bool before = slot->link.is_confirmed();
    const Verdict verdict = slot->link.hear(stamps);
    if (slot->link.is_confirmed() != before) stale_ = true;
    return verdict;
}

void ClockGraph::refresh(Timestamp now) noexcept {
    if (!stale_ && refreshed_ != Timestamp::min() && now - refreshed_ < refresh_interval) return;
    stale_ = false;
    refreshed_ = now;
    weigh_links(now);
    Tree best{master_, 0};
    if (master_ == nobody) {
        const Node heard = most_heard();
        for (const Node candidate : {root_, heard, top_above(heard)}) {
            const Tree tree = grow(candidate);
            if (tree.reached > best.reached) best = tree;
        }
    }
    root_ = grow(best.root).root;
}

void ClockGraph::weigh_links(Timestamp now) noexcept {
    std::fill(heard_by_.begin(), heard_by_.end(), std::uint16_t{0});
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        weights_[i] = unreached;
        const Slot& slot = slots_[i];
        if (slot.transmitter == nobody || !slot.link.is_confirmed()) continue;
        const ClockTrack& track = slot.link.track();
        const double variance = track.variance_after(std::max(0.0, to_s(now) - to_s(track.last_host())));
        if (!(variance <= max_variance_ticks2_)) continue;
        weights_[i] = variance;
        ++heard_by_[slot.transmitter];
    }
}

ClockGraph::Tree ClockGraph::grow(Node root) noexcept {
    std::fill(costs_.begin(), costs_.end(), unreached);
    std::fill(ways_.begin(), ways_.end(), static_cast<std::uint32_t>(slots_.size()));
    if (root == nobody) return {};
    costs_[root] = 0;
    for (std::size_t hop = 0; hop < longest_way && shorten_ways(); ++hop) {
    }
    const auto reached = std::count_if(costs_.begin(), costs_.end(), [](double cost) { return cost < unreached; });
    return {root, static_cast<std::size_t>(reached)};
}

/// One round of Bellman and Ford's. False when nothing became shorter.
bool ClockGraph::shorten_ways() noexcept {
    bool shorter = false;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (weights_[i] == unreached) continue;
        const double cost = costs_[slots_[i].transmitter] + weights_[i];
        if (!(cost < costs_[receiver_of(i)])) continue;
        costs_[receiver_of(i)] = cost;
        ways_[receiver_of(i)] = static_cast<std::uint32_t>(i);
        shorter = true;
    }
    return shorter;
}

ClockGraph::Node ClockGraph::most_heard() const noexcept {
    const auto most = std::max_element(heard_by_.begin(), heard_by_.end());
    return most == heard_by_.end() || *most == 0 ? nobody : static_cast<Node>(most - heard_by_.begin());
}

/// Whom that anchor is synchronised by, and whom that one is, and so on; where all hear all there is no top, and any
/// will do.
ClockGraph::Node ClockGraph::top_above(Node node) const noexcept {
    for (std::size_t hop = 0; node != nobody && hop < longest_way; ++hop) {
        const auto begin = weights_.begin() + static_cast<std::ptrdiff_t>(node * links_per_receiver);
        const auto best = std::min_element(begin, begin + static_cast<std::ptrdiff_t>(links_per_receiver));
        if (*best == unreached) break;
        node = slots_[static_cast<std::size_t>(best - weights_.begin())].transmitter;
    }
    return node;
}

std::optional<ClockGraph::RootTime> ClockGraph::root_time(Node anchor, const LocalTime& when) const noexcept {
    RootTime result;
    result.time.ticks = when.ticks;
    for (Node node = anchor; node != root_; node = slots_[ways_[node]].transmitter) {
        const std::uint32_t way = root_ == nobody ? static_cast<std::uint32_t>(slots_.size()) : ways_[node];
        if (way == slots_.size() || result.length == longest_way) return std::nullopt;
        const Slot& slot = slots_[way];
        const LocalTime here{result.time.ticks, when.host};
        const auto above = slot.link.is_confirmed() ? slot.link.track().at(here) : std::nullopt;
        if (!above) return std::nullopt;
        result.settled = result.settled && slot.link.track().reaches_beyond(here);
        result.links[result.length] = way;
        result.variances_ticks2[result.length++] = above->variance_ticks2;
        const double rest_ticks = result.time.rest_ticks + above->rest_ticks + slot.lead_ticks;
        const std::int64_t whole_ticks = std::llround(rest_ticks);
        result.time.ticks = above->ticks + static_cast<std::uint64_t>(whole_ticks);
        result.time.rest_ticks = rest_ticks - static_cast<double>(whole_ticks);
        result.time.variance_ticks2 += above->variance_ticks2;
    }
    return result;
}

double ClockGraph::variance_between(const RootTime& a, const RootTime& b) noexcept {
    std::size_t common = 0; // the ways meet at some anchor and are one from there to the root
    while (common < std::min(a.length, b.length) && a.links[a.length - 1 - common] == b.links[b.length - 1 - common])
        ++common;
    double variance = 0;
    for (const RootTime* one : {&a, &b})
        for (std::size_t i = 0; i + common < one->length; ++i) variance += one->variances_ticks2[i];
    return variance;
}

} // namespace locus::uwb
