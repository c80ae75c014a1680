#include "drivers/uwb/listener_json.h"
#include "drivers/uwb/navlab.h"
#include "drivers/uwb/pdoa_json.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {
namespace {

template <class Report>
std::vector<DecoderExample> lines(std::string_view decoder, Report (*report)(unsigned)) {
    DecoderExample example{decoder};
    for (unsigned i = 0; i < 20; ++i) example.chunks.push_back(chunk(encode(report(i))));
    example.lines = true;
    example.checksum = false;
    return {example};
}

uwb::ListenerReport listened(unsigned i) {
    namespace frames = uwb::ieee802154;
    uwb::ListenerReport report{959949481290u + i, 32240936, -84.0f, -85.5f, {}};
    const auto frame = i % 2 == 0 ? encode(frames::Blink{static_cast<std::uint8_t>(i), 0x2040BFC210001CF0})
                                  : encode(frames::ClockCalibration{static_cast<std::uint8_t>(i),
                                                                    0x0402C186CFB20492,
                                                                    0x0492,
                                                                    0x400000000,
                                                                    0x07499137C050u + i,
                                                                    0,
                                                                    4,
                                                                    {}});
    report.frame.assign(frame.begin(), frame.end());
    return report;
}

} // namespace

std::vector<DecoderExample> listener_json() { return lines("listener_json", listened); }

std::vector<DecoderExample> navlab() {
    return lines<uwb::NavlabRange>("navlab", [](unsigned i) {
        return uwb::NavlabRange{2, 0x8000, 2, 2333 + static_cast<int>(i), 2288, 2389, -80'000};
    });
}

std::vector<DecoderExample> pdoa_json() {
    return lines<uwb::PdoaReport>("pdoa_json", [](unsigned i) {
        return uwb::PdoaReport{0x2E5C, i, 8605, 343, 1695, 165, 165, 14, 1, {53015, 60972, 10797}};
    });
}

} // namespace locus::examples
