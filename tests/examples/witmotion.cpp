#include "drivers/imu/witmotion.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> witmotion() {
    DecoderExample serial{"witmotion"}, can{"witmotion_can"};
    for (int i = 0; i < 20; ++i) {
        const auto acceleration = imu::wit_acceleration({0.1 * i, -1, 9.8});
        const auto rate = imu::wit_rate({0.05 * i, 0, -0.1});
        const auto first = imu::encode(acceleration), second = imu::encode(rate);
        Chunk both(first.begin(), first.end());
        both.insert(both.end(), second.begin(), second.end());
        serial.chunks.push_back(both);
        can.frames.push_back(imu::encode_can(acceleration, 0x50));
        can.frames.push_back(imu::encode_can(rate, 0x50));
    }
    can.rubbish = {{0x50, 8, {}}, {0x50, 3, {}}};
    return {serial, can};
}

} // namespace locus::examples
