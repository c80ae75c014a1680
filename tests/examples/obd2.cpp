#include "drivers/vehicle/obd2.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> obd2();

std::vector<DecoderExample> obd2() {
    DecoderExample example{"obd2"};
    for (std::uint8_t kmh = 0; kmh < 20; ++kmh)
        example.frames.push_back(vehicle::obd2_answer(vehicle::Pid::speed, kmh));
    example.rubbish = {{0x7E8, 8, {3, 0x7F, 1, 0x12}}, {0x7E8, 2, {}}};
    return {example};
}

} // namespace locus::examples
