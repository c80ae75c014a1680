#include "tools/client/fields.h"

#include <algorithm>

namespace locus::tools {

using nlohmann::json;

namespace {

const json* find(const json& object, std::string_view key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

} // namespace

std::optional<double> number(const json& object, std::string_view key) {
    const json* value = find(object, key);
    if (!value || !value->is_number()) return std::nullopt;
    return value->get<double>();
}

bool flag(const json& object, std::string_view key) {
    const json* value = find(object, key);
    return value && value->is_boolean() && value->get<bool>();
}

std::string text(const json& object, std::string_view key) {
    const json* value = find(object, key);
    return value && value->is_string() ? printable(value->get_ref<const std::string&>()) : std::string{};
}

const json& list(const json& object, std::string_view key) {
    static const json none = json::array();
    const json* value = find(object, key);
    return value && value->is_array() ? *value : none;
}

const json& object(const json& object, std::string_view key) {
    static const json none = json::object();
    const json* value = find(object, key);
    return value && value->is_object() ? *value : none;
}

std::optional<std::array<double, 3>> vector3(const json& object, std::string_view key) {
    const json& values = list(object, key);
    if (values.size() != 3 || !std::ranges::all_of(values, [](const json& v) { return v.is_number(); })) return {};
    return values.get<std::array<double, 3>>();
}

std::string printable(std::string_view text) {
    std::string result(text);
    std::ranges::replace_if(result, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return result;
}

} // namespace locus::tools
