// One flat JSON object as a list of fields with their numbers still as text, so that the field's own type decides how
// they are read, to the last bit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus {

struct JsonField {
    enum class Shape { number, text, list, other };

    std::string name;
    Shape shape = Shape::other;
    std::vector<std::string> values; ///< numbers as written; one text; the numbers of a list
    bool taken = false;              ///< for the reader's use: what stays false was not asked for
};

/// The fields of `line` in order. Empty when it is not one JSON object; `error` then says why. Objects and anything
/// but numbers inside a list make a field of shape `other`. A name that comes twice is an error.
std::optional<std::vector<JsonField>> parse_json_fields(std::string_view line, std::string& error);

} // namespace locus
