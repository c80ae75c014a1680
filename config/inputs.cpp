// Section "inputs": each a transport and a decoder, whose options stand side by side in the input's map.
#include "config/names.h"
#include "config/print_options.h"
#include "config/section.h"
#include "config/uniques.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus::config {
namespace {

constexpr std::string_view wire_name(Wire wire) { return wire == Wire::can ? "CAN frames" : "a stream of bytes"; }

void check_wire(const YamlNode& item, const InputSettings& input, Problems& problems) {
    if (!input.transport || !input.decoder || input.transport->carries(input.decoder->wire)) return;
    const Wire given = *input.transport->wire; // NOLINT(*-unchecked-optional-access): without one it carries every wire
    problems.add(item.find("decoder")->mark,
                 fmt::format("decoder {} needs {}, but transport {} gives {}", input.decoder->name,
                             wire_name(input.decoder->wire), input.transport->name, wire_name(given)));
}

/// What may stand in the map although its table was not found: the settings of every device it could have been.
void append_settings_of(const auto& table, std::vector<std::string_view>& keys) {
    for (const auto& row : table) append_names({row.options.rows, nullptr, row.options.lists}, keys);
}

std::vector<std::string_view> possible_keys(const InputSettings& input) {
    std::vector<std::string_view> keys;
    if (!input.transport) append_settings_of(transport_table(), keys);
    if (!input.decoder) append_settings_of(decoder_table(), keys);
    return keys;
}

/// As written: a link and its device are only seen to be one where the device is plugged in.
void check_device(const YamlNode& item, const InputSettings& input, Uniques& devices, Problems& problems) {
    if (!input.enabled || !input.transport || input.transport->sole_option.empty()) return;
    const YamlNode* device = item.find(input.transport->sole_option);
    if (device && !device->text.empty()) devices.check(device->text, device->mark, problems);
}

void find_rows(const YamlNode& item, InputSettings& input, Problems& problems) {
    input.transport = find_named(item.find("transport"), "transport", transport_table(), problems);
    input.decoder = find_named(item.find("decoder"), "decoder", decoder_table(), problems);
    if (input.transport) input.transport_settings = input.transport->options.make();
    if (input.decoder) input.decoder_settings = input.decoder->options.make();
}

BoundOptions bound(const OptionTable& table, const std::shared_ptr<void>& settings) {
    return {table.rows, settings.get(), table.lists};
}

ShownOptions shown_options(const OptionTable& table, const std::shared_ptr<void>& settings) {
    return {table.rows, settings.get(), table.lists};
}

/// What no row alone can tell; asked only when each is right in itself.
void check_together(const YamlNode& item, const InputSettings& input, Problems& problems) {
    const auto ask = [&](const auto* row, const std::shared_ptr<void>& settings) {
        if (!row || !row->options.check) return;
        if (const std::string wrong = row->options.check(settings.get()); !wrong.empty())
            problems.add(item.mark, fmt::format("input {}: {}", shown(input.name), wrong));
    };
    ask(input.transport, input.transport_settings);
    ask(input.decoder, input.decoder_settings);
}

} // namespace

void check_one_word(const YamlNode& item, const std::string& name, Problems& problems) {
    if (name.empty()) return;
    if (name.size() > 64 || !std::ranges::all_of(name, [](unsigned char c) { return c > ' '; }))
        problems.add(item.find("name")->mark, "name must be one word of at most 64 letters");
}

void read_input(const YamlNode& item, InputSettings& input, std::span<const BoundOptions> more, Problems& problems) {
    find_rows(item, input, problems);
    std::vector<BoundOptions> tables{{input_options, &input}};
    if (input.transport) tables.push_back(bound(input.transport->options, input.transport_settings));
    if (input.decoder) tables.push_back(bound(input.decoder->options, input.decoder_settings));
    tables.insert(tables.end(), more.begin(), more.end());
    const std::size_t problems_before = problems.size();
    read_map(item, {"input", possible_keys(input)}, tables, problems);
    if (problems.size() == problems_before) check_together(item, input, problems);
    check_one_word(item, input.name, problems);
    check_wire(item, input, problems);
}

void read_inputs(const YamlNode& node, std::vector<InputSettings>& inputs, Problems& problems) {
    Uniques names("input with the name");
    Uniques devices("input that reads", ", which only one can");
    for (const auto& item : list_items(node, max_inputs, problems)) {
        InputSettings& input = inputs.emplace_back();
        read_input(item, input, {}, problems);
        if (!input.name.empty()) names.check(input.name, item.mark, problems);
        check_device(item, input, devices, problems);
    }
}

std::string print_inputs(const std::vector<InputSettings>& inputs) {
    if (inputs.empty()) return "inputs: []\n";
    std::string text = "inputs:\n";
    for (const auto& input : inputs) {
        const ShownOptions tables[]{{input_options, &input},
                                    shown_options(input.transport->options, input.transport_settings),
                                    shown_options(input.decoder->options, input.decoder_settings)};
        text += print_block(tables, 2, true);
    }
    return text;
}

} // namespace locus::config
