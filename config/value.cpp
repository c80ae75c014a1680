#include "config/value.h"
#include "config/address.h"
#include "config/nearest.h"
#include "config/parse_plain.h"
#include "config/plain_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus::config {
namespace {

std::string what_stands_here(const YamlNode& node) {
    switch (node.kind) {
    case YamlNode::Kind::nothing:
        return "nothing stands here";
    case YamlNode::Kind::list:
        return "here stands a list";
    case YamlNode::Kind::map:
        return "here stands a map";
    case YamlNode::Kind::scalar:
        break;
    }
    return fmt::format("here stands {}\"{}\"", node.quoted ? "the text " : "", shown(node.text));
}

/// Reads one node for one row; each overload of operator() makes the alternative of OptionValue that the row holds.
class Reader {
  public:
    Reader(const YamlNode& node, const OptionRow& row, Problems& problems)
        : node_(node), row_(row), problems_(problems) {}

    using Result = std::optional<OptionValue>;

    Result operator()(bool shape) const {
        const auto value = is_plain() ? parse_bool(node_.text) : std::nullopt;
        return value ? Result{*value} : wrong_type(shape);
    }

    Result operator()(std::int64_t shape) const {
        const auto value = is_plain() ? parse_integer(node_.text) : std::nullopt;
        if (!value) return wrong_type(shape);
        return within_limits(static_cast<double>(*value)) ? Result{*value} : out_of_range();
    }

    Result operator()(double shape) const {
        const auto value = is_plain() ? parse_double(node_.text) : std::nullopt;
        if (!value) return wrong_type(shape);
        return within_limits(*value) ? Result{*value} : out_of_range();
    }

    Result operator()(Address shape) const {
        const auto value = node_.kind == YamlNode::Kind::scalar ? parse_address(node_.text) : std::nullopt;
        if (!value) return wrong_type(shape);
        return *value == no_address ? problem("is the address that stands for \"none\"; no device has it") : *value;
    }

    Result operator()(const std::string& shape) const {
        if (node_.kind != YamlNode::Kind::scalar) return wrong_type(shape);
        if (row_.required && node_.text.empty()) return problem("is missing: the text is empty");
        if (!is_printable(node_.text)) return problem("holds characters that do not print");
        if (!row_.choices.empty() && std::ranges::find(row_.choices, node_.text) == row_.choices.end())
            return problem(fmt::format("cannot be \"{}\"{}", shown(node_.text), hint(node_.text, row_.choices)));
        return node_.text;
    }

    Result operator()(const Vec3& shape) const {
        Vec3 value{};
        if (node_.kind != YamlNode::Kind::list || node_.children.size() != value.size()) return wrong_type(shape);
        for (std::size_t i = 0; i < value.size(); ++i) {
            const auto component = Reader{node_.children[i], row_, problems_}(double{});
            if (!component) return std::nullopt;
            value[i] = std::get<double>(*component);
        }
        return value;
    }

  private:
    bool is_plain() const { return node_.kind == YamlNode::Kind::scalar && !node_.quoted; }
    bool within_limits(double value) const { return value >= row_.minimum && value <= row_.maximum; }

    Result wrong_type(const OptionValue& shape) const {
        const std::string unit = row_.unit.empty() ? "" : fmt::format(" in {}", row_.unit);
        return problem(fmt::format("must be {}{}; {}", type_name(shape), unit, what_stands_here(node_)));
    }
    Result out_of_range() const {
        return problem(fmt::format("is {}; it must be {}", shown(node_.text), limits_text(row_)));
    }
    Result problem(const std::string& text) const {
        problems_.add(node_.mark, fmt::format("{} {}", row_.name, text));
        return std::nullopt;
    }

    const YamlNode& node_;
    const OptionRow& row_;
    Problems& problems_;
};

} // namespace

std::optional<OptionValue> read_value(const YamlNode& node, const OptionRow& row, const OptionValue& shape,
                                      Problems& problems) {
    return std::visit(Reader{node, row, problems}, shape);
}

} // namespace locus::config
