#include "drivers/gnss/ubx_messages.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

using namespace gnss::ubx;

std::vector<DecoderExample> ubx() {
    DecoderExample example{"ubx"};
    for (std::uint32_t i = 0; i < 10; ++i) {
        NavPvt pvt;
        pvt.time_of_week_ms = 0x2162b508 + i; // with the sync bytes in it
        pvt.fix_type = 3;
        pvt.flags = 1;
        pvt.latitude_1e7_deg = 534507228;
        RelativePosition relative;
        relative.time_of_week_ms = pvt.time_of_week_ms;
        relative.heading_1e5_deg = 12'345'678;
        relative.flags = 0x137;
        const std::vector<RawSignal> signals(
            4, {21431659.961, 112624126.092, 366.01f, 0, 11, 0, 0, 64500, 43, 4, 1, 6, 7, 0});
        example.chunks.push_back(encode(pvt));
        example.chunks.push_back(encode(relative));
        example.chunks.push_back(encode(RawEpoch{223793.0 + i, 2327, 18}, signals));
        example.chunks.push_back(encode(Subframe{0, 5, 0, 0, 10, 0, 2, 0, {0x22c0502e}}));
    }
    return {example};
}

} // namespace locus::examples
