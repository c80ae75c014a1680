#include "tools/sniff/report.h"

#include "tools/show/table.h"
#include "tools/sniff/settings_text.h"
#include "tools/sniff/words.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace locus::sniff {
namespace {

using tools::Align;
using tools::Table;
using Lines = std::vector<std::string>;

constexpr std::size_t ids_shown = 60;

std::string_view word_of(Confidence confidence) {
    switch (confidence) {
    case Confidence::sure:
        return "sure";
    case Confidence::likely:
        return "likely";
    default:
        return "by chance";
    }
}

std::string_view reason_of(const Standing& standing) {
    if (standing.confidence == Confidence::sure) return "damaged frames would have been refused";
    if (standing.guarded) return "but there are few frames";
    return standing.decoder->wire == Wire::can
               ? "but only identifiers and lengths say so: look whether the values make sense"
               : "but nothing guards its frames: look whether the values make sense";
}

void append(Lines& lines, Lines more) { std::ranges::move(more, std::back_inserter(lines)); }

void append_text(Lines& lines, const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back("  " + text.substr(at, end - at));
        at = end + 1;
    }
}

Lines standing_table(const std::vector<Standing>& standings) {
    Table table{{{"decoder"},
                 {"frames", Align::right},
                 {"measurements", Align::right},
                 {"refused", Align::right},
                 {"understood %", Align::right},
                 {"so it is this"}}};
    for (const Standing& s : standings)
        table.add({std::string{s.decoder->name}, fmt::to_string(s.tally.frames),
                   fmt::to_string(s.tally.all_measurements()), fmt::to_string(s.tally.all_refused()),
                   fmt::format("{:.0f}", 100 * s.share), std::string{word_of(s.confidence)}});
    return table.lines();
}

Lines id_table(const std::vector<Census>& ids) {
    Table table{{{"id"}, {"frames", Align::right}, {"Hz", Align::right}, {"bytes"}, {"its bytes"}}};
    for (std::size_t i = 0; i < std::min(ids.size(), ids_shown); ++i) {
        const Census& id = ids[i];
        table.add(
            {id_text(id.can_id), fmt::to_string(id.frames), id.rate_hz > 0 ? fmt::format("{:.1f}", id.rate_hz) : "-",
             id.shortest == id.longest ? fmt::to_string(id.longest) : fmt::format("{} to {}", id.shortest, id.longest),
             columns_text(id.samples)});
    }
    Lines lines = table.lines();
    if (ids.size() > ids_shown) lines.push_back(fmt::format("and {} more", ids.size() - ids_shown));
    return lines;
}

void tell_winners(Lines& lines, const Findings& findings, const Source& source) {
    if (findings.winners.size() > 1)
        lines.emplace_back("\nSeveral understand it: either they share the line, or they cannot be told apart.");
    for (const Standing& winner : findings.winners) {
        lines.push_back(fmt::format("\nThis is {} ({}): {}, {}.\n", winner.decoder->name, winner.decoder->about,
                                    word_of(winner.confidence), reason_of(winner)));
        append_text(lines, input_yaml(winner, source));
    }
}

void tell_guess(Lines& lines, const FrameGuess& guess, const Source& source) {
    const auto& layout = guess.layout;
    lines.push_back(fmt::format(
        "\nNo decoder knows it, but it has frames: {} of them, {} bytes each, {:.0f} % of all bytes.", guess.frames,
        guess.shortest == guess.longest ? fmt::to_string(guess.shortest)
                                        : fmt::format("{} to {}", guess.shortest, guess.longest),
        100 * guess.share));
    lines.push_back(layout.checksum == "none"
                        ? "No checksum that is known holds on them, so where they begin is less sure."
                        : fmt::format("The checksum {} holds on them.", layout.checksum));
    if (const std::string columns = columns_text(guess.samples); !columns.empty())
        lines.push_back("Bytes, counted from 0: " + columns + ".");
    lines.emplace_back("To be filled in (docs/describe-a-device.md):\n");
    append_text(lines, input_yaml(guess, source));
}

void tell_text(Lines& lines, const TextLines& text) {
    lines.push_back(fmt::format("\nNo decoder knows it. It is text: {} lines, the longest has {} characters.",
                                text.lines, text.longest));
    for (const std::string& line : text.first) lines.push_back("  " + line);
}

nlohmann::json standing_json(const Standing& standing) {
    return {{"decoder", standing.decoder->name},       {"confidence", word_of(standing.confidence)},
            {"frames", standing.tally.frames},         {"measurements", standing.tally.all_measurements()},
            {"refused", standing.tally.all_refused()}, {"share", standing.share}};
}

nlohmann::json guess_json(const FrameGuess& guess, const Source& source) {
    return {{"frames", guess.frames},           {"share", guess.share},      {"shortest", guess.shortest},
            {"longest", guess.longest},         {"sync", guess.layout.sync}, {"checksum", guess.layout.checksum},
            {"yaml", input_yaml(guess, source)}};
}

nlohmann::json ids_json(const std::vector<Census>& ids) {
    nlohmann::json list = nlohmann::json::array();
    for (const Census& id : ids)
        list.push_back({{"id", id_text(id.can_id)},
                        {"frames", id.frames},
                        {"rate_hz", id.rate_hz},
                        {"shortest", id.shortest},
                        {"longest", id.longest}});
    return list;
}

std::string yaml_of(const Source& source, std::string_view name, const DecoderRow& decoder) {
    std::string text = fmt::format("inputs:\n  - name: {}\n", name);
    for (const std::string& line : source.lines(decoder)) text += "    " + line + "\n";
    return text + fmt::format("    decoder: {}\n", decoder.name);
}

} // namespace

Findings look_into(const Capture& capture) {
    Findings findings;
    findings.bytes = capture.bytes().size();
    findings.packets = capture.packets();
    findings.duration = capture.duration();
    findings.wire = capture.wire();
    findings.standings = contest(capture);
    findings.winners = winners(findings.standings);
    if (capture.wire() == Wire::can)
        findings.ids = census(capture);
    else if (is_text(capture.bytes()))
        findings.text = lines_of(capture.bytes());
    else if (findings.winners.empty())
        findings.guess = guess_frames(capture.bytes());
    return findings;
}

std::vector<std::string> findings_lines(const Findings& findings, const Source& source) {
    Lines lines{
        fmt::format("{} bytes in {} packets, {:.1f} s", findings.bytes, findings.packets, to_s(findings.duration))};
    if (!findings.standings.empty()) append(lines, standing_table(findings.standings));
    if (!findings.ids.empty()) append(lines, id_table(findings.ids));
    for (const std::string& sentence : looks_like(findings.ids)) lines.push_back("It looks like " + sentence + ".");
    if (!findings.winners.empty())
        tell_winners(lines, findings, source);
    else if (findings.guess)
        tell_guess(lines, *findings.guess, source);
    else if (findings.text)
        tell_text(lines, *findings.text);
    else
        lines.emplace_back(findings.wire == Wire::can
                               ? "\nNo decoder knows it; what changes with what the device does is "
                                 "for can_layout (docs/describe-a-device.md)."
                               : "\nNo decoder knows it, and no frames are to be seen. The wrong baud "
                                 "rate looks like this: try --baud auto.");
    return lines;
}

std::string findings_json(const Findings& findings, const Source& source) {
    nlohmann::json object{{"class", "SNIFF"},
                          {"bytes", findings.bytes},
                          {"packets", findings.packets},
                          {"seconds", to_s(findings.duration)}};
    object["standings"] = object["winners"] = nlohmann::json::array();
    for (const Standing& standing : findings.standings) object["standings"].push_back(standing_json(standing));
    for (const Standing& winner : findings.winners) {
        object["winners"].push_back(standing_json(winner));
        object["winners"].back()["yaml"] = input_yaml(winner, source);
    }
    if (findings.wire == Wire::can) object["ids"] = ids_json(findings.ids);
    if (findings.text) object["lines"] = findings.text->first;
    if (findings.guess) object["guess"] = guess_json(*findings.guess, source);
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string input_yaml(const Standing& standing, const Source& source) {
    std::string text = yaml_of(source, standing.decoder->name, *standing.decoder);
    for (const std::string& line : settings_lines(standing.decoder->options, standing.settings.get()))
        text += "    " + line + "\n";
    return text;
}

std::string input_yaml(const FrameGuess& guess, const Source& source) {
    return yaml_of(source, "unknown", *find_decoder("serial_layout")) + layout_text(guess.layout, 4);
}

} // namespace locus::sniff
