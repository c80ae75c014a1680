// Timestamps as decimal seconds, exact to the nanosecond.
#include "drivers/recording/stamp.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace locus {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::int64_t limit_s = 9'000'000'000;

bool all_digits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The first nine digits as nanoseconds; the tenth rounds.
std::int64_t fraction_ns(std::string_view digits) {
    std::int64_t ns = 0;
    for (std::size_t i = 0; i < 9; ++i) ns = ns * 10 + (i < digits.size() ? digits[i] - '0' : 0);
    return ns + (digits.size() > 9 && digits[9] >= '5');
}

std::optional<Timestamp> parse_with_exponent(std::string_view text) {
    double seconds = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if (!(std::abs(seconds) < static_cast<double>(limit_s))) return std::nullopt;
    return timestamp_from_s(seconds);
}

} // namespace

void append_seconds(std::string& text, Timestamp time) {
    const std::int64_t ns = to_ns(time);
    std::array<char, 24> buffer{};
    // Divided before the sign goes, so that the most negative value has one.
    std::int64_t fraction = ns < 0 ? -(ns % ns_per_s) : ns % ns_per_s;
    const std::int64_t whole = ns < 0 ? -(ns / ns_per_s) : ns / ns_per_s;
    char* const end = std::to_chars(buffer.begin(), buffer.end(), whole).ptr;
    if (ns < 0) text += '-';
    text.append(buffer.begin(), end);
    text += '.';
    for (std::int64_t unit = ns_per_s / 10; unit > 0; unit /= 10) {
        text += static_cast<char>('0' + fraction / unit);
        fraction %= unit;
    }
}

std::optional<Timestamp> parse_seconds(std::string_view text) {
    if (text.find_first_of("eE") != std::string_view::npos) return parse_with_exponent(text);
    const bool negative = text.starts_with('-');
    const std::string_view digits = text.substr(negative);
    const std::size_t dot = std::min(digits.find('.'), digits.size());
    const std::string_view whole_text = digits.substr(0, dot);
    const std::string_view fraction = digits.substr(std::min(dot + 1, digits.size()));
    if (whole_text.empty() || whole_text.size() > 10 || !all_digits(whole_text) || !all_digits(fraction))
        return std::nullopt;
    std::int64_t whole = 0;
    std::from_chars(whole_text.begin(), whole_text.end(), whole);
    if (whole >= limit_s) return std::nullopt;
    const std::int64_t ns = whole * ns_per_s + fraction_ns(fraction);
    return timestamp_from_ns(negative ? -ns : ns);
}

} // namespace locus
