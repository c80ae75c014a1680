// One flat JSON object as a list of fields, by nlohmann's event interface: its tree would turn numbers into doubles.
#include "drivers/recording/json_fields.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace locus {
namespace {

using nlohmann::json;
using Shape = JsonField::Shape;

class FieldCollector : public nlohmann::json_sax<json> {
  public:
    explicit FieldCollector(JsonFields& into) : into_(into) {}

    std::string error = "the line is not one JSON object";

    bool null() override { return value(Shape::other, {}); }
    bool boolean(bool) override { return value(Shape::other, {}); }
    bool number_integer(std::int64_t number) override { return value(Shape::number, std::to_string(number)); }
    bool number_unsigned(std::uint64_t number) override { return value(Shape::number, std::to_string(number)); }
    bool number_float(double, const std::string& text) override { return value(Shape::number, text); }
    bool string(std::string& text) override { return value(Shape::text, text); }
    bool binary(json::binary_t&) override { return false; }
    bool start_object(std::size_t) override {
        if (depth_ > 0) into_.fields.back().shape = Shape::other;
        return ++depth_ < depth_limit;
    }
    bool end_object() override { return leave(); }
    bool start_array(std::size_t) override {
        if (depth_ == 0) return false;
        into_.fields.back().shape = depth_ == 1 ? Shape::list : Shape::other;
        return ++depth_ < depth_limit;
    }
    bool end_array() override { return leave(); }

    bool key(std::string& name) override {
        if (depth_ > 1) return true; // inside a value that is refused as a whole
        const auto is_same = [&](const JsonField& field) { return field.name == name; };
        if (std::any_of(into_.fields.begin(), into_.fields.end(), is_same))
            return refuse("\"" + name + "\" is there twice");
        if (into_.fields.size() == field_limit) return refuse("the line has too many fields");
        into_.fields.push_back({into_.owned.emplace_front(name), Shape::other, into_.values.size()});
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const json::exception&) override {
        error = "the line is not valid JSON at character " + std::to_string(position);
        return false;
    }

  private:
    static constexpr int depth_limit = 16;
    static constexpr std::size_t field_limit = 64; // no kind has half as many; keeps the search for doubles short
    JsonFields& into_;
    int depth_ = 0;

    bool refuse(std::string why) {
        error = std::move(why);
        return false;
    }

    bool leave() {
        --depth_;
        return true;
    }

    bool value(Shape shape, std::string text) {
        if (depth_ == 0) return false;
        JsonField& field = into_.fields.back();
        if (depth_ == 1)
            field.shape = shape;
        else if (shape != Shape::number)
            field.shape = Shape::other;
        if (depth_ > 1 && field.shape != Shape::list) return true;
        into_.values.push_back(into_.owned.emplace_front(std::move(text)));
        ++field.count;
        return true;
    }
};

} // namespace

bool parse_json_fields(std::string_view line, JsonFields& into, std::string& error) {
    FieldCollector collector(into);
    if (json::sax_parse(line, &collector)) return true;
    error = std::move(collector.error);
    return false;
}

} // namespace locus
