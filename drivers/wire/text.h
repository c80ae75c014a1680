// Reads a line of text from its left end, piece by piece. What does not stand there as asked leaves the line as it was.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

namespace locus::wire {

class Text {
  public:
    explicit Text(std::string_view text) : rest_(text) {}

    bool done() const { return rest_.empty(); }
    bool begins(std::string_view text) const { return rest_.starts_with(text); }

    /// Exactly these characters.
    bool literal(std::string_view text) {
        if (!begins(text)) return false;
        rest_.remove_prefix(text.size());
        return true;
    }

    /// As many decimal digits as stand there, with a minus sign if Number is signed.
    template <class Number>
    bool number(Number& number) {
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
        if (error != std::errc{}) return false;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return true;
    }

    /// All hex digits that stand there, if they are `digits`.
    template <class Number>
    bool hex(std::size_t digits, Number& number) {
        if (hex_digits() != digits) return false;
        std::from_chars(rest_.begin(), rest_.begin() + digits, number, 16);
        rest_.remove_prefix(digits);
        return true;
    }
    /// Two hex digits, whatever stands behind them.
    bool hex_byte(std::uint8_t& byte) {
        if (rest_.size() < 2 || std::from_chars(rest_.begin(), rest_.begin() + 2, byte, 16).ptr != rest_.begin() + 2)
            return false;
        rest_.remove_prefix(2);
        return true;
    }
    /// How many hex digits stand there.
    std::size_t hex_digits() const { return std::min(rest_.find_first_not_of("0123456789abcdefABCDEF"), rest_.size()); }

    /// A number with exactly two decimals, as "-0.04", in hundredths.
    bool hundredths(std::int64_t& value) {
        Text ahead = *this;
        const bool negative = ahead.literal("-");
        std::uint32_t whole = 0, decimals = 0;
        const bool good = ahead.number(whole) && ahead.literal(".") && ahead.digits() == 2 && ahead.number(decimals);
        if (!good) return false;
        value = std::int64_t{whole} * 100 + decimals;
        if (negative) value = -value;
        *this = ahead;
        return true;
    }

  private:
    std::string_view rest_;

    std::size_t digits() const { return std::min(rest_.find_first_not_of("0123456789"), rest_.size()); }
};

} // namespace locus::wire
