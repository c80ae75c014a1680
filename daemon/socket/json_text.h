// Numbers and texts as JSON, written by hand where there are thousands a second: no stream, no locale, nothing that is
// not finite.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace locus {

/// Fixed point with `decimals` digits; far from 1 in general notation. `value` is finite.
void append_fixed(std::string& out, double value, int decimals);

/// Nine significant digits. `value` is finite.
void append_general(std::string& out, double value);

/// With quotation marks and escapes; what is not UTF-8 is replaced.
void append_text(std::string& out, std::string_view text);

/// ,"key":[a,b,c]; nothing at all when one of them is not finite.
void append_vector(std::string& out, std::string_view key, std::span<const double> values);

bool all_finite(std::span<const double> values);

} // namespace locus
