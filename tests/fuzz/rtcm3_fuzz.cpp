// RTCM 3 from any bytes, and any message with the frame and checksum that it needs to be looked into.
#include "drivers/gnss/rtcm3_frame.h"
#include "tests/fuzz/decoder_fuzz.h"

using namespace locus::gnss::rtcm3;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const locus::wire::Bytes bytes{data, size};
    locus::fuzz::check("rtcm3", bytes);
    locus::fuzz::check("rtcm3", frame(bytes.first(std::min(size, longest_message))));
    return 0;
}
