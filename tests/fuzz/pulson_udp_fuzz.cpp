// PulsON messages from any datagram; whatever is read is written again the same.
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
    const std::span message{data, size};
    locus::fuzz::run_bytes("pulson_udp", message, std::max<std::size_t>(size, 1));
    check<RangeRequest>(message), check<Confirm>(message), check<FullRange>(message), check<SmallRange>(message);
    check<EchoedRange>(message), check<DataInfo>(message), check<ScanInfo>(message), check<FullScan>(message);
    check<FullNeighbors>(message), check<SmallNeighbors>(message), check<Config>(message), check<StatusInfo>(message);
    return 0;
}
