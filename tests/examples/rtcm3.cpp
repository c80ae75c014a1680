#include "tests/examples/decoder_example.h"
#include "tests/support/rtcm3_encoder.h"

namespace locus::examples {

namespace encoder = test::rtcm3;

/// Pseudoranges only: a place by itself measures nothing.
std::vector<DecoderExample> rtcm3() {
    DecoderExample example{"rtcm3"};
    const std::vector<encoder::Cell> cells{{3, 2, 2.11e7}, {17, 2, 2.34e7, 38}, {30, 2, 2.5e7, 0}};
    for (std::uint64_t i = 0; i < 6; ++i) {
        const std::uint64_t ms = 211'000'000 + 1000 * i;
        example.chunks.push_back(encoder::msm(1077, 0xD3, ms, cells)); // station and sync byte are alike
        example.chunks.push_back(encoder::msm(1124, 7, ms, cells));
        example.chunks.push_back(encoder::gps_l1(7, ms, cells));
    }
    return {example};
}

} // namespace locus::examples
