// Measurement <-> JSON line: a writer and a reader that walk the same table of fields.
#include "drivers/recording/measurement_json.h"

#include "drivers/recording/json_fields.h"
#include "drivers/recording/measurement_fields.h"
#include "drivers/recording/stamp.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace locus {
namespace {

constexpr std::array<std::string_view, 3> line_of_sight_names{"unknown", "clear", "blocked"};

class Writer {
  public:
    explicit Writer(std::string& line) : line_(line) {}

    template <class T>
    void must(std::string_view name, const T& value) {
        if (!writable(value)) return;
        line_.append(",\"").append(name).append("\":");
        append(value);
    }
    void may(std::string_view name, LineOfSight value) {
        if (value != LineOfSight::unknown) must(name, value);
    }
    void may(std::string_view name, Address value) {
        if (value != no_address) must(name, value);
    }
    void may(std::string_view name, const Looks& value) {
        if (value != Looks{}) must(name, value);
    }
    template <class T>
    void may(std::string_view name, const T& value) {
        must(name, value);
    }
    void gone(std::string_view) {}

  private:
    template <class T>
    static bool writable(const T& value) {
        if constexpr (std::is_floating_point_v<T>)
            return std::isfinite(value);
        else
            return true;
    }
    template <class T, std::size_t Size>
    static bool writable(const std::array<T, Size>& values) {
        return std::all_of(values.begin(), values.end(), [](T value) { return writable(value); });
    }

    template <class Number>
        requires std::is_arithmetic_v<Number>
    void append(Number value) {
        if constexpr (std::is_floating_point_v<Number>)
            if (value == 0 && std::signbit(value)) return void(line_ += "-0.0"); // JSON's "-0" reads as a whole 0
        std::array<char, 32> buffer; // the shortest text of a double that reads back to it has 24 characters
        line_.append(buffer.data(), std::to_chars(buffer.begin(), buffer.end(), value).ptr);
    }
    void append(Address value) { append(number(value)); }
    void append(LineOfSight value) {
        line_.append("\"").append(line_of_sight_names[static_cast<std::size_t>(value)]).append("\"");
    }
    template <class T, std::size_t Size>
    void append(const std::array<T, Size>& values) {
        for (std::size_t i = 0; i < Size; ++i) {
            line_ += i == 0 ? '[' : ',';
            append(values[i]);
        }
        line_ += ']';
    }

    std::string& line_;
};

/// Takes fields by name; the first thing that is wrong stays in `error`, what follows is not looked at.
class Reader {
  public:
    explicit Reader(JsonFields& line) : line_(line) {}
    std::string error;

    template <class T>
    void must(std::string_view name, T& value) {
        if (!take(name, value)) fail(name, "is missing");
    }
    template <class T>
    void may(std::string_view name, T& value) {
        take(name, value);
    }
    void gone(std::string_view name) {
        std::uint32_t value = 0;
        take(name, value);
    }

    void nothing_left() {
        for (const JsonField& field : line_.fields)
            if (!field.taken) fail(field.name, "is not a field of this class");
    }

  private:
    void fail(std::string_view name, std::string_view what) {
        if (error.empty()) error.append("\"").append(name).append("\" ").append(what);
    }

    template <class T>
    bool take(std::string_view name, T& value) {
        JsonField* const field = find(name);
        if (field == nullptr) return false;
        field->taken = true;
        read(*field, value);
        return true;
    }

    /// Fields mostly come in the order in which they are asked for.
    JsonField* find(std::string_view name) {
        std::vector<JsonField>& fields = line_.fields;
        const auto expected = fields.begin() + static_cast<std::ptrdiff_t>(expected_);
        const auto has_name = [&](const JsonField& field) { return field.name == name; };
        auto found = std::find_if(expected, fields.end(), has_name);
        if (found == fields.end()) {
            found = std::find_if(fields.begin(), expected, has_name);
            if (found == expected) return nullptr;
        }
        expected_ = static_cast<std::size_t>(found - fields.begin()) + 1;
        return &*found;
    }

    std::string_view one(const JsonField& field) const { return line_.of(field).front(); }

    template <class Number>
    static bool parse(std::string_view text, Number& number) {
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (status != std::errc{} || end != text.data() + text.size()) return false;
        if constexpr (std::is_floating_point_v<Number>) return std::isfinite(number);
        return true;
    }

    template <class Number>
        requires std::is_floating_point_v<Number>
    void read(const JsonField& field, Number& number) {
        if (field.shape != JsonField::Shape::number || !parse(one(field), number))
            fail(field.name, "must be a finite number");
    }
    template <class Number>
        requires std::is_integral_v<Number>
    void read(const JsonField& field, Number& number) {
        if (field.shape == JsonField::Shape::number && parse(one(field), number)) return;
        fail(field.name, "must be a whole number from 0 to " + std::to_string(std::numeric_limits<Number>::max()));
    }
    void read(const JsonField& field, Address& value) {
        std::uint64_t number = 0;
        read(field, number);
        value = address(number);
    }
    void read(const JsonField& field, std::string& text) {
        if (field.shape == JsonField::Shape::text)
            text = one(field);
        else
            fail(field.name, "must be a text");
    }
    void read(const JsonField& field, Timestamp& time) {
        const auto parsed = field.shape == JsonField::Shape::number ? parse_seconds(one(field)) : std::nullopt;
        if (parsed)
            time = *parsed;
        else
            fail(field.name, "must be a time in seconds, less than 9e9 from zero");
    }
    void read(const JsonField& field, LineOfSight& value) {
        const auto& names = line_of_sight_names;
        const auto name =
            field.shape == JsonField::Shape::text ? std::find(names.begin(), names.end(), one(field)) : names.end();
        if (name == names.end())
            fail(field.name, R"(must be "clear", "blocked" or "unknown")");
        else
            value = static_cast<LineOfSight>(name - names.begin());
    }
    template <class T, std::size_t Size>
    void read(const JsonField& field, std::array<T, Size>& values) {
        const auto texts = line_.of(field);
        bool good = field.shape == JsonField::Shape::list && texts.size() == Size;
        for (std::size_t i = 0; good && i < Size; ++i) good = parse(texts[i], values[i]);
        const std::string_view numbers = std::is_integral_v<T> ? " whole numbers" : " finite numbers";
        const std::string limit = sizeof(T) == 1 ? " from 0 to 255" : "";
        if (!good) fail(field.name, "must be a list of " + std::to_string(Size).append(numbers).append(limit));
    }

    JsonFields& line_;
    std::size_t expected_ = 0;
};

template <std::size_t Kind = 0>
bool emplace_kind(std::size_t kind, Observation& observation) {
    if constexpr (Kind == std::variant_size_v<Observation>)
        return false;
    else if (kind == Kind)
        return observation.emplace<Kind>(), true;
    else
        return emplace_kind<Kind + 1>(kind, observation);
}

} // namespace

std::string to_json_line(const Measurement& measurement) {
    std::string line = "{\"t\":";
    append_seconds(line, measurement.time);
    line.append(R"(,"class":")").append(observation_names[measurement.observation.index()]).append("\"");
    Writer writer(line);
    writer.must("input", measurement.input);
    writer.must("sequence", measurement.sequence);
    std::visit([&](const auto& sample) { visit_fields(writer, sample); }, measurement.observation);
    line += '}';
    return line;
}

namespace {

std::optional<Measurement> measurement_of(JsonFields& fields, std::string& error) {
    Reader reader(fields);
    Measurement measurement;
    std::string name;
    reader.must("t", measurement.time);
    reader.must("class", name);
    reader.must("input", measurement.input);
    reader.must("sequence", measurement.sequence);
    const auto kind = std::find(observation_names.begin(), observation_names.end(), name);
    if (reader.error.empty() &&
        !emplace_kind(static_cast<std::size_t>(kind - observation_names.begin()), measurement.observation))
        reader.error = R"("class" is ")" + name + R"(", which is not a class of measurements)";
    std::visit([&](auto& sample) { visit_fields(reader, sample); }, measurement.observation);
    reader.nothing_left();
    if (reader.error.empty()) return measurement;
    error = std::move(reader.error);
    return std::nullopt;
}

} // namespace

/// Twice where it has to be: what the quick way does not take as good, the slow one judges.
std::optional<Measurement> from_json_line(std::string_view line, std::string& error) {
    constexpr std::size_t usual_fields = 24, usual_values = 40;
    JsonFields plain;
    plain.fields.reserve(usual_fields);
    plain.values.reserve(usual_values);
    if (plain_json_fields(line, plain)) {
        std::string told_again_below;
        if (const auto measurement = measurement_of(plain, told_again_below)) return measurement;
    }
    JsonFields fields;
    if (!parse_json_fields(line, fields, error)) return std::nullopt;
    return measurement_of(fields, error);
}

} // namespace locus
