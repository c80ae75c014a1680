#include "tests/examples/decoder_example.h"

#include <cctype>
#include <charconv>
#include <stdexcept>

namespace locus::examples {

std::vector<DecoderExample> apps_json();
std::vector<DecoderExample> cwru_can();
std::vector<DecoderExample> dw1000_can();
std::vector<DecoderExample> dwm1001();
std::vector<DecoderExample> epson_g370();
std::vector<DecoderExample> layouts();
std::vector<DecoderExample> listener_json();
std::vector<DecoderExample> loco_sniffer();
std::vector<DecoderExample> navlab();
std::vector<DecoderExample> nlink();
std::vector<DecoderExample> nmea();
std::vector<DecoderExample> obd2();
std::vector<DecoderExample> pdoa_json();
std::vector<DecoderExample> pulson();
std::vector<DecoderExample> radio();
std::vector<DecoderExample> robomaster();
std::vector<DecoderExample> rtcm3();
std::vector<DecoderExample> trek1000();
std::vector<DecoderExample> tum();
std::vector<DecoderExample> ubx();
std::vector<DecoderExample> vectornav();
std::vector<DecoderExample> witmotion();
std::vector<DecoderExample> xsens();

namespace {

constexpr std::array families{apps_json,     cwru_can,     dw1000_can, dwm1001,    epson_g370, layouts,
                              listener_json, loco_sniffer, navlab,     nlink,      nmea,       obd2,
                              pdoa_json,     pulson,       radio,      robomaster, rtcm3,      trek1000,
                              tum,           ubx,          vectornav,  witmotion,  xsens};

std::vector<DecoderExample> gather() {
    std::vector<DecoderExample> examples;
    for (const auto family : families)
        for (DecoderExample& example : family()) examples.push_back(std::move(example));
    return examples;
}

} // namespace

const std::vector<DecoderExample>& all() {
    static const std::vector<DecoderExample> examples = gather();
    return examples;
}

std::unique_ptr<Decoder> DecoderExample::make() const {
    const DecoderRow* row = find_decoder(decoder);
    if (!row) throw std::runtime_error("no decoder " + std::string{decoder});
    return row->make(settings ? settings.get() : row->options.make().get());
}

Chunk from_hex(std::string_view hex) {
    std::string digits;
    for (const char c : hex)
        if (!std::isspace(static_cast<unsigned char>(c))) digits += c;
    Chunk bytes(digits.size() / 2);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        if (std::from_chars(&digits[2 * i], &digits[2 * i] + 2, bytes[i], 16).ptr != &digits[2 * i] + 2)
            throw std::runtime_error("no hex: " + std::string{hex});
    return bytes;
}

} // namespace locus::examples
