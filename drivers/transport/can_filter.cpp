#include "drivers/transport/can_filter.h"

#include "drivers/recording/can_text.h"
#include "drivers/recording/hex.h"

#include <linux/can/raw.h>

#include <algorithm>

namespace locus {
namespace {

bool parse_filter(std::string_view word, can_filter& filter) {
    const std::size_t colon = word.find(':');
    if (!parse_can_id(word.substr(0, colon), filter.can_id) || (filter.can_id & CAN_ERR_FLAG)) return false;
    const canid_t all = filter.can_id & CAN_EFF_FLAG ? CAN_EFF_MASK : CAN_SFF_MASK;
    canid_t mask = all;
    if (colon != std::string_view::npos && (!parse_hex_number(word.substr(colon + 1), mask) || mask > all))
        return false;
    filter.can_mask = mask | CAN_EFF_FLAG | CAN_RTR_FLAG; // else an extended id with the same low bits passes too
    return true;
}

} // namespace

std::vector<can_filter> parse_can_filters(std::string_view text, std::string& error) {
    std::vector<can_filter> filters;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(','));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        filters.emplace_back();
        if (parse_filter(word, filters.back())) continue;
        error = "the CAN filter '" + std::string{word} + "' is not like 123, 200:7F0 or 18FF1234";
        return {};
    }
    if (filters.size() > CAN_RAW_FILTER_MAX) error = "more than 512 CAN filters";
    return filters;
}

} // namespace locus
