// Any bytes as a radio map: a map or problems, never both; what is taken can be written, read back and asked.
#include "config/radio_map.h"
#include "fusion/radio/neighbours.h"

#include <cstdint>
#include <cstdlib>

namespace {

std::vector<locus::radio::Reading> fingerprint_of(const locus::radio::ReferencePoint& point) {
    std::vector<locus::radio::Reading> readings;
    for (const auto& strength : point.heard) readings.push_back({strength.beacon, strength.mean_dbm});
    return readings;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    locus::config::Problems problems("fuzz");
    const auto map = locus::config::parse_radio_map({reinterpret_cast<const char*>(data), size}, problems);
    if (map.has_value() != problems.empty()) std::abort();
    if (!map) return 0;
    locus::config::Problems again("written");
    const auto read_back = locus::config::parse_radio_map(locus::config::radio_map_yaml(*map), again);
    if (!read_back || read_back->points.size() != map->points.size()) std::abort();
    const double floor_dbm = locus::radio::hearing_floor_dbm(*map);
    for (const auto& point : map->points) {
        const auto place = locus::radio::nearest_neighbours(*map, fingerprint_of(point), {}, floor_dbm);
        if (place && !place->allFinite()) std::abort();
    }
    return 0;
}
