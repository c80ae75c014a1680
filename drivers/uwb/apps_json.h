// Lines of JSON that Decawave's uwb-apps print on a DW1000 node (protocols.md 1(c2)): ranges of twr_node_tdma and
// twr_nranges_tdma, range differences and pressure of rtdoa_tag. Numbers stand in quotes as often as not.
//
//   {"utime": 9484254696807, "twr": {"rng": "1.071","uid": "d22d"},"uid": "55a6", "diag": {"rssi": "-79.562","los":
//   "1.000"}}
//   {"utime": 88307220,"nrng": {"seq": 224,"mask": 127,"rng": ["8.088","8.039"],"uid": ["1946","5199"]}}
//   {"id":"0x499b","pres":102072,"ref_anchor":"492","meas":[{"addr":"533","ddist":"0.698","tqf":1,"rssi":"-79.9"}]}
//
// "ddist" is taken as distance to "addr" less distance to "ref_anchor"; no recording with a known place shows its sign.
// Other lines (clocks, what a firmware says when it starts) are frames without a measurement. There is no checksum.
#pragma once

#include "drivers/decoder.h"

#include <boost/container/static_vector.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace locus::uwb {

namespace apps {

inline constexpr std::size_t most_peers = 32; ///< bits of "mask"

/// What a node measured to one peer or, as initiator, to many.
struct Ranges {
    struct Item {
        std::uint64_t peer = 0;
        double range_m = 0;
        bool operator==(const Item&) const = default;
    };
    std::optional<std::uint64_t> node; ///< left out by twr_nranges_tdma
    boost::container::static_vector<Item, most_peers> items;
    float rx_power_dbm = unknown_f;                   ///< of a single range
    LineOfSight line_of_sight = LineOfSight::unknown; ///< "los": 1 clear, 0 blocked, between them not sure
};

/// What a tag that only listens measured: how much farther each anchor is than the reference.
struct Differences {
    struct Item {
        std::uint64_t anchor = 0;
        double difference_m = 0;
        bool operator==(const Item&) const = default;
    };
    std::uint64_t node = 0;
    std::uint64_t reference = 0;
    boost::container::static_vector<Item, most_peers> items;
    std::optional<double> pressure_pa;
};

using Report = std::variant<std::monostate, Ranges, Differences>;

/// Empty when the line is damaged; monostate when it tells something else.
std::optional<Report> parse(std::string_view text);

/// A line with "\r\n"; as of twr_node_tdma if it has one item and a node, else as of twr_nranges_tdma.
std::string encode(const Ranges& ranges);
std::string encode(const Differences& differences);

} // namespace apps

struct AppsSettings {
    Address node = no_address;
    bool node_is_anchor = false;
};

inline constexpr std::array apps_options{
    option<&AppsSettings::node>("node", "", -no_limit, no_limit,
                                "Address of the node on this line, for lines that do not tell it.", {}, true),
    option<&AppsSettings::node_is_anchor>("node_is_anchor", "Whether that node is an anchor, and its peers are tags."),
};

std::unique_ptr<Decoder> make_apps_json(const void* settings);

} // namespace locus::uwb
