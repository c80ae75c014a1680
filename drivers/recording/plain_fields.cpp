// The quick way into a recording's line. It only ever accepts: a line that is not as plain as this is read again by
// nlohmann's parser, which says what is wrong with it.
#include "drivers/recording/json_fields.h"

#include <algorithm>

namespace locus {
namespace {

class PlainScanner {
  public:
    PlainScanner(std::string_view line, JsonFields& into)
        : at_(line.data()), end_(line.data() + line.size()), into_(into) {}

    bool object() {
        if (!take('{')) return false;
        do
            if (!field()) return false;
        while (take(','));
        if (!take('}')) return false;
        skip_space();
        return at_ == end_;
    }

  private:
    using Shape = JsonField::Shape;
    /// No number that is as short as this, with an exponent of two digits, is too large for a double.
    static constexpr std::ptrdiff_t longest_number = 64, longest_exponent = 2;

    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    void skip_space() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\r' || *at_ == '\n')) ++at_;
    }
    bool next_is(char c) const { return at_ != end_ && *at_ == c; }
    bool take(char c) {
        skip_space();
        if (!next_is(c)) return false;
        ++at_;
        return true;
    }
    bool skip_digits() {
        const char* const from = at_;
        at_ = std::find_if_not(at_, end_, is_digit);
        return at_ != from;
    }

    bool field() {
        JsonField field;
        if (!text(field.name) || !take(':')) return false;
        skip_space();
        field.first = into_.values.size();
        if (!value(field)) return false;
        field.count = into_.values.size() - field.first;
        into_.fields.push_back(field);
        return true;
    }

    bool value(JsonField& field) {
        if (take('[')) {
            field.shape = Shape::list;
            return list();
        }
        field.shape = next_is('"') ? Shape::text : Shape::number;
        std::string_view one;
        if (!(field.shape == Shape::text ? text(one) : number(one))) return false;
        into_.values.push_back(one);
        return true;
    }

    bool list() {
        do {
            std::string_view one;
            skip_space();
            if (!number(one)) return false;
            into_.values.push_back(one);
        } while (take(','));
        return take(']');
    }

    bool text(std::string_view& text) {
        if (!take('"')) return false;
        const char* const from = at_;
        at_ = std::find_if(at_, end_, [](char c) { return c == '"' || c == '\\' || c < ' ' || c > '~'; });
        text = {from, static_cast<std::size_t>(at_ - from)};
        if (!next_is('"')) return false;
        ++at_;
        return true;
    }

    /// JSON's grammar of numbers (RFC 8259, section 6). -0 is left to the other reader, to which it is a whole 0.
    bool number(std::string_view& number) {
        const char* const from = at_;
        if (next_is('-')) ++at_;
        const char* const first = at_;
        if (!skip_digits() || (*first == '0' && at_ - first > 1)) return false;
        const bool whole_zero = *first == '0';
        bool whole = true;
        if (next_is('.')) {
            whole = false;
            ++at_;
            if (!skip_digits()) return false;
        }
        if (next_is('e') || next_is('E')) {
            whole = false;
            if (!exponent()) return false;
        }
        number = {from, static_cast<std::size_t>(at_ - from)};
        return at_ - from <= longest_number && !(whole && whole_zero && first != from);
    }
    bool exponent() {
        ++at_;
        if (next_is('-') || next_is('+')) ++at_;
        const char* const from = at_;
        return skip_digits() && at_ - from <= longest_exponent;
    }

    const char* at_;
    const char* end_;
    JsonFields& into_;
};

} // namespace

bool plain_json_fields(std::string_view line, JsonFields& into) { return PlainScanner(line, into).object(); }

} // namespace locus
