#include "drivers/uwb/robomaster_can.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> robomaster() {
    DecoderExample example{"robomaster_can"};
    for (int i = 0; i < 20; ++i)
        for (const CanFrame& frame : uwb::encode(uwb::RobomasterRecord{1, 2, 3, {251, 402, 333, 287, 1, 2}, 0}, {}))
            example.frames.push_back(frame);
    example.rubbish = {example.frames[2], example.frames[2]};
    return {example};
}

} // namespace locus::examples
