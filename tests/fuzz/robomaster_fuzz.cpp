// Any CAN frames with any identifiers, lengths and gaps through robomaster_can.
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    locus::fuzz::check_can("robomaster_can", {data, size});
    return 0;
}
