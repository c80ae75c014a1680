#include "drivers/slam/tum.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {
namespace {

DecoderExample poses(const char* stamps) {
    slam::TumSettings settings;
    settings.tag = address(7);
    settings.stamps = stamps;
    DecoderExample example{"tum"};
    for (unsigned i = 0; i < 20; ++i)
        example.chunks.push_back(
            chunk(encode(slam::TumPose{1311868171.131477 + i / 30., {0.01 * i, 0.5, -2.25}, {0, 0.6, 0, -0.8}})));
    example.lines = true;
    example.checksum = false;
    example.settings = std::make_shared<slam::TumSettings>(settings);
    return example;
}

} // namespace

std::vector<DecoderExample> tum() { return {poses("device"), poses("arrival")}; }

} // namespace locus::examples
