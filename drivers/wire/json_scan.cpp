// JSON as RFC 8259 has it, but numbers are taken for what from_chars reads later, and escapes are not checked.
#include "drivers/wire/json_scan.h"

#include <algorithm>

namespace locus::wire {
namespace {

/// Reads at `at`, and moves it behind what was read.
class Scan {
  public:
    Scan(std::string_view text, std::size_t& at) : text_(text), at_(at) {}

    void blanks() {
        while (at_ < text_.size() && std::string_view{" \t\r\n"}.find(text_[at_]) != std::string_view::npos) ++at_;
    }
    bool character(char wanted) {
        blanks();
        if (at_ == text_.size() || text_[at_] != wanted) return false;
        ++at_;
        return true;
    }
    bool string(std::string_view& inside) {
        if (!character('"')) return false;
        for (const std::size_t begin = at_; at_ < text_.size() && static_cast<unsigned char>(text_[at_]) >= ' ';
             ++at_) {
            if (text_[at_] == '\\') {
                if (++at_ == text_.size()) return false;
            } else if (text_[at_] == '"') {
                inside = text_.substr(begin, at_++ - begin);
                return true;
            }
        }
        return false;
    }
    bool value(JsonValue& value, int depth) {
        blanks();
        if (at_ == text_.size()) return false;
        switch (text_[at_]) {
        case '"':
            value.kind = JsonValue::Kind::string;
            return string(value.text);
        case '[':
            value.kind = JsonValue::Kind::list;
            return nested(value, ']', depth);
        case '{':
            value.kind = JsonValue::Kind::object;
            return nested(value, '}', depth);
        default:
            return word(value);
        }
    }

  private:
    std::string_view text_;
    std::size_t& at_;

    /// A number, true, false or null.
    bool word(JsonValue& value) {
        const std::size_t end =
            std::min(text_.find_first_not_of("+-.0123456789abcdefghijklmnopqrstuvwxyzE", at_), text_.size());
        value.text = text_.substr(at_, end - at_);
        at_ = end;
        if (value.text.empty()) return false;
        value.kind = JsonValue::Kind::number;
        if (value.text == "null") value.kind = JsonValue::Kind::nothing;
        if (value.text == "true" || value.text == "false") value.kind = JsonValue::Kind::truth;
        const char c = value.text[0];
        return value.kind != JsonValue::Kind::number || c == '-' || (c >= '0' && c <= '9');
    }

    /// A list or an object.
    bool nested(JsonValue& outer, char end, int depth) {
        const std::size_t begin = at_++;
        if (depth == 0) return false;
        for (bool first = true; !character(end); first = false) {
            std::string_view name;
            JsonValue inner;
            if (!first && !character(',')) return false;
            if (end == '}' && (!string(name) || !character(':'))) return false;
            if (!value(inner, depth - 1)) return false;
        }
        outer.text = text_.substr(begin, at_ - begin);
        return true;
    }
};

} // namespace

JsonValue JsonValue::first() const {
    if (kind != Kind::list) return *this;
    JsonValue value;
    return JsonList{*this}.next(value) ? value : JsonValue{};
}

JsonObject::JsonObject(std::string_view text) : text_(text) { good_ = Scan{text_, at_}.character('{'); }

bool JsonObject::next(JsonMember& member) {
    Scan scan{text_, at_};
    if (!good_ || closed_) return false;
    if (scan.character('}')) {
        closed_ = true;
        scan.blanks();
        return false;
    }
    good_ = (first_ || scan.character(',')) && scan.string(member.name) && scan.character(':') &&
            scan.value(member.value, deepest);
    first_ = false;
    return good_;
}

bool JsonList::next(JsonValue& value) {
    Scan scan{inside_, at_};
    const bool good = (first_ || scan.character(',')) && scan.value(value, JsonObject::deepest);
    first_ = false;
    return good;
}

} // namespace locus::wire
