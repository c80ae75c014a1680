// TREK1000 lines from any bytes; whatever parses is written again as something that parses to the same report.
#include "drivers/uwb/trek1000.h"
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    locus::fuzz::check("trek1000", {data, size});
    const auto report = locus::uwb::parse_trek_report({reinterpret_cast<const char*>(data), size});
    if (!report) return 0;
    std::string line = locus::uwb::encode(*report);
    line.resize(line.size() - 2);
    if (locus::uwb::parse_trek_report(line) != report) std::abort();
    return 0;
}
