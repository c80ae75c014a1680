#include "tests/examples/decoder_example.h"
#include "tests/support/rtcm3_encoder.h"

namespace locus::examples {

namespace encoder = test::rtcm3;

/// A place by itself measures nothing, so it goes with the pseudoranges after it.
std::vector<DecoderExample> rtcm3() {
    DecoderExample example{"rtcm3"};
    const std::vector<encoder::Cell> cells{{3, 2, 2.11e7}, {17, 2, 2.34e7, 38}, {30, 2, 2.5e7, 0}};
    for (std::uint64_t i = 0; i < 6; ++i) {
        Chunk chunk = encoder::place(1005, 7, {4177000.1 + static_cast<double>(i), 855000.2, 4727000.3});
        const auto ranges =
            encoder::msm(1077, 7, 211'000'000 + 1000 * i, cells); // sync bytes inside are left to chance
        chunk.insert(chunk.end(), ranges.begin(), ranges.end());
        example.chunks.push_back(chunk);
        example.chunks.push_back(encoder::msm(1124, 7, 211'000'000 + 1000 * i, cells));
        example.chunks.push_back(encoder::gps_l1(7, 211'000'000 + 1000 * i, cells));
    }
    return {example};
}

} // namespace locus::examples
