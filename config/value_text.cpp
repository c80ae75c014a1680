// Values as text: for `locus config --print`, for messages and for the reference page.
#include "config/address.h"
#include "config/value.h"

#include <fmt/format.h>

#include <cmath>

namespace locus::config {
namespace {

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
    std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
    std::string operator()(double value) const { return std::isnan(value) ? "" : fmt::format("{}", value); }
    std::string operator()(Address value) const { return value == no_address ? "" : to_text(value); }
    std::string operator()(const std::string& value) const { return quoted(value); }
    std::string operator()(const Vec3& v) const {
        if (std::isnan(v[0]) || std::isnan(v[1]) || std::isnan(v[2])) return "";
        return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
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
    const auto text = [&](double limit) { return fmt::format("{}{}{}", limit, row.unit.empty() ? "" : " ", row.unit); };
    if (std::isinf(row.minimum) && std::isinf(row.maximum)) return "";
    if (std::isinf(row.maximum)) return "at least " + text(row.minimum);
    if (std::isinf(row.minimum)) return "at most " + text(row.maximum);
    return fmt::format("between {} and {}", text(row.minimum), text(row.maximum));
}

} // namespace locus::config
