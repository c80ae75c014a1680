#include "drivers/radio/cc2531.h"
#include "drivers/radio/hm10.h"
#include "drivers/radio/mac_header.h"
#include "drivers/radio/xbee.h"
#include "drivers/radio/znp.h"
#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> radio();

namespace {

DecoderExample xbee(bool escaped) {
    radio::XbeeSettings settings;
    settings.receiver = address(1);
    settings.escaped = escaped;
    DecoderExample example{"xbee"};
    for (int i = 0; i < 20; ++i) {
        example.chunks.push_back(encode(radio::XbeeFrame{0x81, 0x1100 + i, -45 - i}, escaped));
        example.chunks.push_back(encode(radio::XbeeFrame{0x80, 0x0013A20040A1B2C3, -60}, escaped));
    }
    example.settings = std::make_shared<radio::XbeeSettings>(settings);
    return example;
}

DecoderExample znp() {
    DecoderExample example{"znp"};
    for (int i = 0; i < 20; ++i)
        example.chunks.push_back(encode(radio::ZnpIncoming{8, 0x17D4, static_cast<std::uint8_t>(50 + i), 0x00DBB299}));
    example.weak = true;
    example.settings = std::make_shared<radio::ZnpSettings>(radio::ZnpSettings{address(1), -95, 0.4});
    return example;
}

DecoderExample hm10() {
    DecoderExample example{"hm10"};
    for (int i = 0; i < 20; ++i)
        example.chunks.push_back(chunk(encode(radio::Hm10Record{"4C000215", "74278BDAB64445208F0C720EAF059935", 0xFFE0,
                                                                0xFFE1, -59, 0x78A5048CECACu, -53 - i})));
    example.checksum = false;
    return example;
}

DecoderExample cc2531() {
    DecoderExample example{"cc2531"};
    for (std::uint8_t i = 0; i < 20; ++i) {
        const radio::MacHeader::Node everybody{0x1234, 0xFFFF, false}, lamp{0x1234, 0x7700u + i, false};
        const Chunk frame = encode(radio::MacHeader{1, i, everybody, lamp});
        example.chunks.push_back(encode(radio::Cc2531Record{1000u * i, frame, 28, true, 106}));
    }
    example.checksum = false;
    example.settings = std::make_shared<radio::Cc2531Settings>(radio::Cc2531Settings{address(1)});
    return example;
}

} // namespace

std::vector<DecoderExample> radio() { return {xbee(false), xbee(true), znp(), hm10(), cc2531()}; }

} // namespace locus::examples
