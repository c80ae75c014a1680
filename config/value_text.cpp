// Values as text: for `locus config --print`, for messages and for the reference page.
#include "config/address.h"
#include "config/value.h"

#include <array>
#include <charconv>
#include <cmath>

namespace locus::config {
namespace {

/// Shortest decimal that reads back to the same number (std::to_chars).
std::string shortest(auto number) {
    std::array<char, 32> digits{};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    return {digits.data(), end};
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

struct ToYaml {
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t value) const { return shortest(value); }
    std::string operator()(double value) const { return std::isnan(value) ? "" : shortest(value); }
    std::string operator()(Address value) const { return value == no_address ? "" : to_text(value); }
    std::string operator()(const std::string& value) const { return quoted(value); }
    std::string operator()(const Vec3& v) const {
        if (std::isnan(v[0]) || std::isnan(v[1]) || std::isnan(v[2])) return "";
        return "[" + shortest(v[0]) + ", " + shortest(v[1]) + ", " + shortest(v[2]) + "]";
    }
};

struct TypeName {
    std::string operator()(bool) const { return "true or false"; }
    std::string operator()(std::int64_t) const { return "a whole number"; }
    std::string operator()(double) const { return "a number"; }
    std::string operator()(Address) const { return "an address (3, 0x1234 or DE:CA:...)"; }
    std::string operator()(const std::string&) const { return "text"; }
    std::string operator()(const Vec3&) const { return "three numbers [x, y, z]"; }
};

} // namespace

std::string to_yaml(const OptionValue& value) { return std::visit(ToYaml{}, value); }
std::string type_name(const OptionValue& shape) { return std::visit(TypeName{}, shape); }

std::string limits_text(const OptionRow& row) {
    const std::string unit = row.unit.empty() ? "" : " " + std::string(row.unit);
    const auto text = [&](double limit) { return shortest(limit) + unit; };
    if (std::isinf(row.minimum) && std::isinf(row.maximum)) return "";
    if (std::isinf(row.maximum)) return "at least " + text(row.minimum);
    if (std::isinf(row.minimum)) return "at most " + text(row.maximum);
    return "between " + text(row.minimum) + " and " + text(row.maximum);
}

} // namespace locus::config
