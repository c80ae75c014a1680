// PulsON messages over USB from any bytes. Without a checksum a message is believed when it comes and doubted when
// something else follows at once, so the cut of the stream matters here; whatever is read is written again the same.
#include "drivers/uwb/pulson/messages.h"
#include "drivers/uwb/pulson/neighbors.h"
#include "drivers/uwb/pulson/radio_info.h"
#include "tests/fuzz/decoder_fuzz.h"

namespace {

/// What is reserved may hold anything, so it is the second writing that must be like the first.
template <class Message>
void check(std::span<const std::uint8_t> bytes) {
    const auto message = locus::uwb::pulson::parse<Message>(bytes);
    if (!message) return;
    const auto written = encode(*message);
    const auto again = locus::uwb::pulson::parse<Message>(written);
    if (written.size() != bytes.size() || !again || encode(*again) != written) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace locus::uwb::pulson;
    for (const std::size_t chunk : {std::max<std::size_t>(size, 1), std::size_t{1}, std::size_t{7}})
        locus::fuzz::run_bytes("pulson_usb", {data, size}, chunk);
    if (size < 4) return 0;
    const std::span<const std::uint8_t> message{data + 4, size - 4};
    check<RangeRequest>(message), check<Confirm>(message), check<FullRange>(message), check<SmallRange>(message);
    check<EchoedRange>(message), check<DataInfo>(message), check<ScanInfo>(message), check<FullScan>(message);
    check<FullNeighbors>(message), check<SmallNeighbors>(message), check<Config>(message), check<StatusInfo>(message);
    return 0;
}
