#include "drivers/gnss/nmea_messages.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> nmea() {
    DecoderExample example{"nmea"};
    for (int i = 0; i < 20; ++i) {
        const gnss::nmea::Gga gga{i * 1'000'000, 49.1308885, -122.7032905, 1, 3, 9.97, 516.7, -16.7};
        std::string line = encode(gga);
        line.erase(line.size() - 2, 1); // without "\r": a line that lost it is whole
        example.chunks.push_back(chunk(line));
    }
    example.lines = true;
    return {example};
}

} // namespace locus::examples
