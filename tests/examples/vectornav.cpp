#include "drivers/imu/vectornav.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> vectornav() {
    DecoderExample example{"vectornav"};
    for (unsigned i = 0; i < 20; ++i) {
        const imu::VectorNavData data{1'000'000ull * i, Vec3{0, 0.01 * i, -1}, Vec3{0.1 * i, 0, -9.8},
                                      Vec3{0.2, 0, 0.4}, std::nullopt};
        example.chunks.push_back(i % 4 == 3 ? chunk(imu::encode_vnymr(data)) : imu::encode(data));
    }
    return {example};
}

} // namespace locus::examples
