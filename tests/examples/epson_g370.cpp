#include "drivers/imu/epson_g370.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> epson_g370() {
    DecoderExample example{"epson_g370"};
    for (int i = 0; i < 20; ++i)
        example.chunks.push_back(imu::encode(imu::EpsonBurst{0x7E00,
                                                             0x05235D74,
                                                             {70'000 * i, -5, 80'000'000},
                                                             {3, 0x0D80'0000, 0x9C4'0000 + i},
                                                             0,
                                                             static_cast<std::uint16_t>(i)},
                                             {}));
    return {example};
}

} // namespace locus::examples
