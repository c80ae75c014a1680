// A YAML file as a plain tree with a mark on every node. yaml-cpp's own node type loses double keys, follows aliases
// and grows without bound; here its parser only sends events, and what a settings file has no use for is refused.
#pragma once

#include "config/problems.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus::config {

struct YamlNode {
    enum class Kind { nothing, scalar, list, map };
    Kind kind = Kind::nothing;
    Mark mark;
    std::string text;    ///< of a scalar
    bool quoted = false; ///< a scalar that is text whatever it looks like
    std::vector<YamlNode> children;
    std::string key; ///< when this node is the value of a map's entry
    Mark key_mark;

    /// The value under `wanted` of a map; nullptr when there is none.
    const YamlNode* find(std::string_view wanted) const;
};

inline constexpr std::size_t max_file_bytes = 1024 * 1024;
inline constexpr std::size_t max_depth = 16;
inline constexpr std::size_t max_nodes = 200'000;
inline constexpr std::size_t max_keys = 256; ///< of one map; lists may be longer

/// Empty when the text cannot be read as one YAML document without aliases and tags; a double key is a problem but no
/// reason to stop. Never throws but std::bad_alloc.
std::optional<YamlNode> parse_yaml(std::string_view text, Problems& problems);

} // namespace locus::config
