#include "tools/recorder/session.h"

#include <algorithm>

namespace locus::tools {
namespace {

using Part = RecordSession::Part;

/// The decoder runs along for its counts: whether the bytes make sense is worth knowing before one drives home.
InputParts input_parts(const InputSettings& settings, LogTap& tap, const RecordSession::OnEvent& on_event) {
    InputParts parts;
    parts.name = settings.name;
    parts.transport = settings.transport->make(settings.transport_settings.get());
    parts.decoder = settings.decoder->make(settings.decoder_settings.get());
    parts.tap = &tap;
    parts.on_event = [name = settings.name, on_event](const InputEvent& event) { on_event(name, event); };
    return parts;
}

} // namespace

RecordSession::Part::Part(const InputSettings& settings, LogFile& file, const OnEvent& on_event)
    : tap{settings.name, file}, input{input_parts(settings, tap, on_event)} {}

RecordSession::RecordSession(const std::vector<InputSettings>& settings, LogFile& file, const OnEvent& on_event) {
    for (const InputSettings& one : settings) {
        if (one.enabled) parts_.push_back(std::make_unique<Part>(one, file, on_event));
    }
    for (const auto& part : parts_) {
        part->thread = std::jthread{[&input = part->input](const std::stop_token& stop) { input.run(stop); }};
    }
}

void RecordSession::stop() {
    for (const auto& part : parts_) part->thread.request_stop();
    for (const auto& part : parts_) {
        if (part->thread.joinable()) part->thread.join();
    }
}

bool RecordSession::ended() const {
    return std::all_of(parts_.begin(), parts_.end(),
                       [](const auto& part) { return part->input.status().state == InputState::ended; });
}

} // namespace locus::tools
