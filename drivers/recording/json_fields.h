// One flat JSON object as a list of fields with their numbers still as text, so that the field's own type decides how
// they are read, to the last bit.
#pragma once

#include <forward_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace locus {

struct JsonField {
    enum class Shape { number, text, list, other };

    std::string_view name;
    Shape shape = Shape::other;
    std::size_t first = 0, count = 0; ///< its part of JsonFields::values
    bool taken = false;               ///< for the reader's use: what stays false was not asked for
};

/// Refers to the line that it was read from.
struct JsonFields {
    std::vector<JsonField> fields;
    std::vector<std::string_view> values; ///< numbers as written; one text; the numbers of a list
    std::forward_list<std::string> owned; ///< names and values that do not stand in the line as they are

    std::span<const std::string_view> of(const JsonField& field) const {
        return std::span(values).subspan(field.first, field.count);
    }
};

/// The fields of `line` in order, behind those that are there. False when it is not one JSON object; `error` then says
/// why. Objects and anything but numbers inside a list make a field of shape `other`. A name that comes twice is an
/// error.
bool parse_json_fields(std::string_view line, JsonFields& into, std::string& error);

/// The same of a line as recordings have them, some five times as fast: names and texts of plain ASCII, numbers, lists
/// of numbers. False for whatever else, also what is no JSON: then parse_json_fields() has the word, and this has left
/// anything in `into`. Whether a name comes twice it does not look.
bool plain_json_fields(std::string_view line, JsonFields& into);

} // namespace locus
