// Any bytes, or any CAN frames with any identifiers, lengths and gaps, through the decoder that the build names.
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    locus::fuzz::check(LOCUS_DECODER, {data, size});
    return 0;
}
