#include "drivers/imu/xsens.h"
#include "drivers/imu/xsens_can.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> xsens() {
    DecoderExample serial{"xsens"}, can{"xsens_can"};
    for (unsigned i = 0; i < 20; ++i) {
        serial.chunks.push_back(imu::encode(
            imu::XsensData{static_cast<std::uint16_t>(i), 25 * i, {}, Vec3{0.1 * i, 0, 9.8}, Vec3{0, 0.01 * i, -1}}));
        for (const CanFrame& frame : imu::encode(
                 imu::XsensCanSample{25 * i, static_cast<std::uint16_t>(i), {0, 0.01 * i, -1}, {0.1 * i, 0, 9.8}}))
            can.frames.push_back(frame);
    }
    can.rubbish = {{0x05, 3, {}}, {0x32, 8, {}}};
    return {serial, can};
}

} // namespace locus::examples
