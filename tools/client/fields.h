// Reading of the daemon's JSON that takes nothing for granted: a field that is absent or of another type is unknown.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace locus::tools {

std::optional<double> number(const nlohmann::json& object, std::string_view key);
bool flag(const nlohmann::json& object, std::string_view key);

/// Empty when absent. Made printable: names come from files and devices.
std::string text(const nlohmann::json& object, std::string_view key);

/// An empty array, or object, when absent or something else.
const nlohmann::json& list(const nlohmann::json& object, std::string_view key);
const nlohmann::json& object(const nlohmann::json& object, std::string_view key);

/// Three numbers; empty when one of them is missing.
std::optional<std::array<double, 3>> vector3(const nlohmann::json& object, std::string_view key);

/// Control characters as '?': nothing that comes over the socket may move the cursor.
std::string printable(std::string_view text);

} // namespace locus::tools
