// The lines of a *.log recording: whatever is read is written again as a line that reads to the same.
#include "drivers/recording/log_line.h"

#include <algorithm>
#include <cstdlib>

namespace {

void check(std::string_view line) {
    std::string error;
    const auto record = locus::from_log_line(line, error);
    if (!record) return;
    if (record->data.size() > (record->wire == locus::Wire::can ? 64u : 4096u)) std::abort();
    const std::string written = locus::to_log_line(record->input, record->packet());
    const auto again = locus::from_log_line(written, error);
    if (!again || locus::to_log_line(again->input, again->packet()) != written) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view text{reinterpret_cast<const char*>(data), size};
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        check(line);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return 0;
}
