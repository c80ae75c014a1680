// Any bytes as a settings file: an answer with settings or with problems, never both, and what is good prints to what
// is good.
#include "config/load.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto result = locus::load_settings_text(text, "fuzz");
    if (result.settings.has_value() != result.problems.empty()) std::abort();
    for (const auto& problem : result.problems)
        if (problem.message.empty() || problem.line < 0 || problem.column < 0) std::abort();
    if (!result.settings) return 0;
    const auto printed = locus::print_settings(*result.settings);
    const auto again = locus::load_settings_text(printed, "printed");
    if (!again.settings || locus::print_settings(*again.settings) != printed) std::abort();
    return 0;
}
