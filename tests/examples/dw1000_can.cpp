#include "drivers/uwb/dw1000_can.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> dw1000_can() {
    DecoderExample example{"dw1000_can"};
    for (unsigned i = 0; i < 20; ++i)
        example.frames.push_back(*uwb::encode(Range{address(i % 8), address(i), 2.5 + i, 0.1f}, {}, 0, i));
    example.rubbish = {{0x342, 8, {}}, {0x340, 3, {}}};
    return {example};
}

} // namespace locus::examples
