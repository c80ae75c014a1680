// A line of a *.jsonl recording: whatever is read is written again as something that reads to the same line, and what
// the quick way into it takes, the slow one reads alike.
#include "drivers/recording/json_fields.h"
#include "drivers/recording/measurement_json.h"

#include <algorithm>
#include <cstdlib>

namespace {

void compare_ways(std::string_view line) {
    locus::JsonFields plain, judged;
    std::string error;
    if (!locus::plain_json_fields(line, plain) || !locus::parse_json_fields(line, judged, error)) return;
    const auto same = [&](const locus::JsonField& a, const locus::JsonField& b) {
        return a.name == b.name && a.shape == b.shape && std::ranges::equal(plain.of(a), judged.of(b));
    };
    if (!std::ranges::equal(plain.fields, judged.fields, same)) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string error;
    const std::string_view text{reinterpret_cast<const char*>(data), size};
    compare_ways(text);
    const auto measurement = locus::from_json_line(text, error);
    if (!measurement) return error.empty() ? std::abort(), 0 : 0;
    const std::string line = locus::to_json_line(*measurement);
    const auto again = locus::from_json_line(line, error);
    if (!again || locus::to_json_line(*again) != line) std::abort();
    return 0;
}
