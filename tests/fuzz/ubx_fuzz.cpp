// UBX frames from any bytes; the payload of any message that parses is written again as the same bytes.
#include "drivers/gnss/ubx_messages.h"
#include "tests/fuzz/decoder_fuzz.h"

using namespace locus::gnss::ubx;

namespace {
void same_again(locus::wire::Bytes payload, const std::vector<std::uint8_t>& frame) {
    if (!std::ranges::equal(payload, payload_of(frame))) std::abort();
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    locus::fuzz::check("ubx", {data, size});
    const locus::wire::Bytes payload{data, size};
    if (const auto pvt = parse_nav_pvt(payload)) same_again(payload, encode(*pvt));
    if (const auto subframe = parse_subframe(payload)) same_again(payload, encode(*subframe));
    if (const auto report = parse_sensor_report(payload)) same_again(payload, encode(*report));
    if (const auto epoch = parse_raw_epoch(payload)) {
        std::vector<RawSignal> signals;
        for (std::size_t i = 0; i < epoch->signals; ++i) signals.push_back(parse_raw_signal(payload, i));
        same_again(payload, encode(*epoch, signals));
    }
    return 0;
}
