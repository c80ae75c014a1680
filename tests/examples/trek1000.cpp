#include "drivers/uwb/trek1000.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> trek1000() {
    DecoderExample example{"trek1000"};
    for (int i = 0; i < 20; ++i)
        example.chunks.push_back(
            chunk(encode(uwb::TrekReport{'c', 15, 4, {1260 + i, 2286, 2174, 9999}, 27840, 10, 10511403})));
    example.lines = true;
    example.checksum = false;
    return {example};
}

} // namespace locus::examples
