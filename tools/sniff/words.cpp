#include "tools/sniff/words.h"

#include "drivers/recording/measurement_json.h"
#include "tools/sniff/settings_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace locus::sniff {
namespace {

constexpr std::size_t most_columns = 64;

enum class Column { stays, counts, changes };

Column kind_of(const std::vector<std::vector<std::uint8_t>>& frames, std::size_t at) {
    std::size_t same = 0, up = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const auto step = static_cast<std::uint8_t>(frames[i][at] - frames[i - 1][at]);
        same += step == 0, up += step == 1;
    }
    if (same + 1 == frames.size()) return Column::stays;
    return up * 10 >= (frames.size() - 1) * 8 ? Column::counts : Column::changes;
}

std::string span_text(std::size_t first, std::size_t last) {
    return first == last ? fmt::to_string(first) : fmt::format("{}-{}", first, last);
}

} // namespace

std::string short_hex(wire::Bytes bytes, std::size_t most) {
    std::string text;
    const bool cut = bytes.size() > most;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const bool left_out = cut && i >= most - 2 && i + 1 < bytes.size();
        if (left_out && i > most - 2) continue;
        text += text.empty() ? "" : " ";
        text += left_out ? ".." : fmt::format("{:02X}", bytes[i]);
    }
    return text;
}

std::string short_words(Timestamp time, const Observation& observation) {
    const auto fields = nlohmann::ordered_json::parse(to_json_line({time, 0, 0, observation}));
    std::string text = fields.value("class", "");
    for (const auto& [name, value] : fields.items()) {
        if (name == "class" || name == "t" || name == "input" || name == "sequence") continue;
        text += fmt::format(" {} {}", name, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return text;
}

std::string layout_text(const layout::SerialLayoutSettings& layout, std::size_t indent) {
    const std::string blanks(indent, ' ');
    std::string text;
    for (const std::string& line : settings_lines(find_decoder("serial_layout")->options, &layout))
        text += blanks + line + "\n";
    text += blanks + "fields: # none is known yet; this one makes no measurement\n";
    for (const auto& field : layout.fields)
        text += fmt::format("{}  - {{quantity: {}, at_byte: {}, bytes: {}}}\n", blanks, field.quantity, field.at_byte,
                            field.bytes);
    return text;
}

std::string columns_text(const std::vector<std::vector<std::uint8_t>>& frames) {
    if (frames.size() < 2) return "";
    const std::size_t shortest = std::ranges::min(frames, {}, [](const auto& f) { return f.size(); }).size();
    const std::size_t end = std::min(shortest, most_columns);
    std::string text;
    for (std::size_t first = 0, last = 0; first < end; first = last + 1) {
        const Column kind = kind_of(frames, first);
        last = first;
        while (last + 1 < end && kind != Column::counts && kind_of(frames, last + 1) == kind) ++last;
        if (kind == Column::changes) continue;
        const std::span bytes{frames[0].data() + first, last - first + 1};
        text += text.empty() ? "" : ", ";
        text += span_text(first, last) + (kind == Column::counts ? " counts up" : " always " + short_hex(bytes));
    }
    return text.empty() ? "all change" : text + ", the rest changes";
}

} // namespace locus::sniff
