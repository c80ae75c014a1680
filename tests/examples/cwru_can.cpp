#include "drivers/uwb/cwru_can.h"

#include "tests/examples/decoder_example.h"

#include <limits>

namespace locus::examples {

std::vector<DecoderExample> cwru_can();

std::vector<DecoderExample> cwru_can() {
    DecoderExample example{"cwru_can"};
    for (std::uint8_t anchor = 0; anchor < 20; ++anchor)
        example.frames.push_back(encode(uwb::CwruDistance{anchor, 3.25f}, 1, anchor % 2 == 0));
    example.rubbish = {{1, 7, {}}, encode(uwb::CwruDistance{1, std::numeric_limits<float>::quiet_NaN()}, 1, true)};
    example.settings = std::make_shared<uwb::CwruSettings>(uwb::CwruSettings{1, address(7), 0, 0});
    return {example};
}

} // namespace locus::examples
