// What the tests of decoder `tum` share.
#pragma once

#include "drivers/slam/tum.h"
#include "tests/unit/drivers/collector.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace locus::slam {

inline TumSettings worn_by_seven(const char* stamps = "device") {
    TumSettings settings;
    settings.tag = address(7);
    settings.stamps = stamps;
    return settings;
}

/// What it makes of the text in chunks of `size`.
inline test::Collector tum_decoded(std::string_view text, const TumSettings& settings = worn_by_seven(),
                                   std::size_t size = 1000) {
    test::Collector sink;
    const auto decoder = make_tum(&settings);
    for (; !text.empty(); text.remove_prefix(std::min(size, text.size())))
        decoder->decode(test::bytes_packet(text.substr(0, size)), sink);
    return sink;
}

inline std::string at(double time_s) { return encode(TumPose{time_s, {1, 2, 3}, {0, 0, 0, 1}}); }

} // namespace locus::slam
