// A line of a *.jsonl recording: whatever is read is written again as something that reads to the same line.
#include "drivers/recording/measurement_json.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string error;
    const auto measurement = locus::from_json_line({reinterpret_cast<const char*>(data), size}, error);
    if (!measurement) return error.empty() ? std::abort(), 0 : 0;
    const std::string line = locus::to_json_line(*measurement);
    const auto again = locus::from_json_line(line, error);
    if (!again || locus::to_json_line(*again) != line) std::abort();
    return 0;
}
