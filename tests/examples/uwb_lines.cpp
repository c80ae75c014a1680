#include "drivers/uwb/apps_json.h"
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

std::vector<DecoderExample> apps_json() {
    DecoderExample example{"apps_json"};
    for (unsigned i = 0; i < 20; ++i) {
        uwb::apps::Ranges one{0x55a6, {}, unknown_f, {}}, many;
        one.items.push_back({0xd22d, 1.071 + i});
        for (unsigned k = 0; k < 7; ++k) many.items.push_back({0x1946 + k, 8.088 + i});
        uwb::apps::Differences differences{0x499b, 0x492, {}, 102072};
        differences.items.push_back({0x533, 0.698 + i});
        for (const std::string& line : {encode(one), encode(many), encode(differences)})
            example.chunks.push_back(chunk(line));
    }
    example.lines = true;
    example.checksum = false;
    example.settings = std::make_shared<uwb::AppsSettings>(uwb::AppsSettings{address(9), false});
    return {example};
}

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
