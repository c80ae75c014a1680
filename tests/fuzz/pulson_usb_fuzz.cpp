// PulsON messages over USB from any bytes. Without a checksum a message is believed when it comes and doubted when
// something else follows at once, so here the cut of the stream does matter.
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const std::size_t chunk : {std::max<std::size_t>(size, 1), std::size_t{1}, std::size_t{7}})
        locus::fuzz::run_bytes("pulson_usb", {data, size}, chunk);
    return 0;
}
