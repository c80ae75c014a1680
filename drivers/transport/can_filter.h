// Which CAN ids an input wants, so that the kernel need not wake the thread for the rest of a busy bus.
#pragma once

#include <linux/can.h>

#include <string>
#include <string_view>
#include <vector>

namespace locus {

/// "123,200:7F0,18FF1234": hex ids of 3 (standard) or 8 (extended) digits, each with an optional mask of the bits that
/// count. Data frames only. Empty text gives no filters, which means every frame. With a sentence in `error` when it
/// cannot be read.
std::vector<can_filter> parse_can_filters(std::string_view text, std::string& error);

} // namespace locus
