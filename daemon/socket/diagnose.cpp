#include "daemon/socket/diagnose.h"

#include "daemon/socket/pose_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace locus {
namespace {

using Sentences = std::vector<std::string>;

std::string trouble_of(const InputEntry& input) {
    const std::string trouble = input.status->trouble.get();
    return trouble.empty() ? "it was not opened yet" : trouble;
}

std::uint64_t refused(const InputStatus& status) {
    std::uint64_t sum = 0;
    for (const auto& counter : status.refused) sum += counter.load();
    return sum;
}

std::string silent_input(const InputEntry& input) {
    const InputStatus& status = *input.status;
    if (status.bytes == 0) return fmt::format("input \"{}\" is open, but not one byte has come", input.name);
    if (refused(status) > 0)
        return fmt::format(
            "input \"{}\" receives bytes, but the decoder \"{}\" understands none of them: wrong device, "
            "decoder or speed?",
            input.name, input.decoder);
    return fmt::format("input \"{}\" receives bytes, but no measurement came out of them yet", input.name);
}

void add_input(Sentences& sentences, const InputEntry& input) {
    if (!input.status || input.status->measurements > 0) return;
    const InputState state = input.status->state;
    if (state == InputState::starting || state == InputState::waiting)
        sentences.push_back(fmt::format("input \"{}\" is not open: {}", input.name, trouble_of(input)));
    if (state == InputState::open) sentences.push_back(silent_input(input));
}

void add_inputs(Sentences& sentences, const Roster& roster) {
    if (std::ranges::none_of(roster.inputs, [](const InputEntry& input) { return input.status != nullptr; }))
        sentences.emplace_back("no input is configured or enabled: nothing can be heard");
    for (const InputEntry& input : roster.inputs) add_input(sentences, input);
}

void add_sources(Sentences& sentences, const Picture& picture, const Roster& roster) {
    for (const AidStatus& source : picture.sources()) {
        const Exclusion reason = source.last_verdict.reason;
        if (reason == Exclusion::none || reason == Exclusion::not_seen_yet) continue;
        sentences.push_back(
            fmt::format("source {}: {}", roster.names.source(source.kind, source.source), exclusion_sentence(reason)));
    }
}

void add_targets(Sentences& sentences, const Picture& picture, const Roster& roster) {
    for (const auto& [address, view] : picture.targets())
        sentences.push_back(
            fmt::format("target {}: {}", roster.names.target(address), missing_sentence(view.pose.estimate.missing)));
    if (picture.targets().empty()) sentences.emplace_back("no target is configured and none was heard");
}

} // namespace

bool is_working(const Picture& picture) {
    return std::ranges::any_of(picture.targets(), [](const auto& entry) { return is_publishable(entry.second.pose); });
}

Sentences diagnose(const Picture& picture, const Roster& roster) {
    Sentences sentences;
    if (is_working(picture)) return sentences;
    if (roster.anchors == 0)
        sentences.emplace_back("the site has no anchors: list them under site in the configuration");
    add_inputs(sentences, roster);
    add_targets(sentences, picture, roster);
    add_sources(sentences, picture, roster);
    return sentences;
}

} // namespace locus
