// The members of one JSON object in a line of text, without the heap: for devices that print a flat object a frame.
// Values that are lists or objects come as their text. Of strings, escapes are left as they stand.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace locus::wire {

struct JsonValue {
    enum class Kind : std::uint8_t { nothing, truth, number, string, list, object };
    Kind kind = Kind::nothing; ///< `nothing`: null
    std::string_view text;     ///< of a string what stands between its quotes; of lists and objects with their brackets

    /// A number, or a string that holds one: many firmwares quote their numbers.
    template <class Number>
    std::optional<Number> number() const {
        if (kind != Kind::number && kind != Kind::string) return std::nullopt;
        Number value{};
        const auto [end, error] = std::from_chars(text.begin(), text.end(), value);
        if (error != std::errc{} || end != text.end()) return std::nullopt;
        return value;
    }
    /// Whether it is one; else `into` stays as it was.
    template <class Number>
    bool read(Number& into) const {
        const auto value = number<Number>();
        if (value) into = *value;
        return value.has_value();
    }
    /// The first value of a list; of anything else, itself.
    JsonValue first() const;
};

struct JsonMember {
    std::string_view name;
    JsonValue value;
};

class JsonObject {
  public:
    static constexpr int deepest = 8; ///< nesting that is followed

    explicit JsonObject(std::string_view text);

    /// The next member. False after the last, and where the text is no JSON.
    bool next(JsonMember& member);
    /// After the last member: the object was closed, and nothing follows it.
    bool whole() const { return closed_ && at_ == text_.size(); }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
    bool first_ = true;
    bool good_ = false;
    bool closed_ = false;
};

/// The values of a list that stood in an object: what a JsonObject gave is good as it is.
class JsonList {
  public:
    explicit JsonList(const JsonValue& list)
        : inside_(list.kind == JsonValue::Kind::list ? list.text.substr(1, list.text.size() - 2) : "") {}

    /// The next value. False after the last.
    bool next(JsonValue& value);

  private:
    std::string_view inside_;
    std::size_t at_ = 0;
    bool first_ = true;
};

} // namespace locus::wire
