// Which anchor's clock is the site's, and by which sync packets every other anchor is brought to it: directly, or by an
// anchor that is itself brought there. Of several ways the most certain one is taken, which mostly is the shortest. The
// choice of the root moves no result: all that leaves are differences between anchors, and what two ways have in common
// cancels.
#pragma once

#include "fusion/site.h"
#include "fusion/uwb/clock_sync/clock_link.h"

#include <optional>
#include <vector>

namespace locus::uwb {

class ClockGraph {
  public:
    using Node = std::uint16_t; ///< index of an anchor in the site
    static constexpr Node nobody = 0xFFFF;
    /// Sync packets between an anchor and the root.
    static constexpr std::size_t longest_way = 4;
    /// Transmitters that one anchor is synchronised by at a time.
    static constexpr std::size_t links_per_receiver = 8;

    /// An anchor's time in the root's clock, and the links that brought it there, from the anchor upwards.
    struct RootTime {
        RemoteTime time;
        std::array<std::uint32_t, longest_way> links{};
        std::array<double, longest_way> variances_ticks2{};
        std::size_t length = 0;
        bool settled = true; ///< every link knows a packet that came after
    };

    /// nobody: the address is not an anchor of the site.
    static Node node_of(const Site& site, Address address) noexcept;

    /// `site` outlives the graph.
    ClockGraph(const Site& site, const ClockSyncSettings& settings);

    /// A sync packet between two anchors of the site.
    Verdict hear(Node transmitter, Node receiver, const SyncStamps& stamps) noexcept;

    /// Chooses root and ways anew if there is reason to: a clock came to be believed, or half a second went by.
    void refresh(Timestamp now) noexcept;

    /// Empty when no way leads from this anchor to the root, or a clock on it is not known then.
    std::optional<RootTime> root_time(Node anchor, const LocalTime& when) const noexcept;

    Node root() const noexcept { return root_; }

    /// Variance of the time between two anchors: the links that only one of them came by.
    static double variance_between(const RootTime& a, const RootTime& b) noexcept;

  private:
    struct Slot {
        Node transmitter = nobody;
        double lead_ticks = 0; ///< how long a packet was on its way, antenna to antenna and through the radio
        ClockLink link;
    };
    struct Tree {
        Node root = nobody;
        std::size_t reached = 0;
    };

    Slot* slot_for(Node transmitter, Node receiver, Timestamp host) noexcept;
    void open(Slot& slot, Node transmitter, Node receiver) noexcept;
    void weigh_links(Timestamp now) noexcept;
    Tree grow(Node root) noexcept;
    bool shorten_ways() noexcept;
    Node most_heard() const noexcept;
    Node top_above(Node node) const noexcept;
    Node receiver_of(std::size_t slot) const noexcept { return static_cast<Node>(slot / links_per_receiver); }

    const Site& site_;
    Node master_ = nobody; ///< by the settings
    double max_variance_ticks2_;
    std::vector<Slot> slots_;             ///< links_per_receiver for each anchor
    std::vector<double> weights_;         ///< beside slots_: variance now; infinite: not to be used
    std::vector<double> costs_;           ///< by anchor: variance of its way
    std::vector<std::uint32_t> ways_;     ///< by anchor: slot of the first link on its way up; own slots_.size(): none
    std::vector<std::uint16_t> heard_by_; ///< by anchor: how many it synchronises directly
    Node root_ = nobody;
    Timestamp refreshed_ = Timestamp::min();
    bool stale_ = false;
};

} // namespace locus::uwb
