#include "daemon/inputs.h"

#include <fmt/format.h>

namespace locus {

std::string fingerprint_of(const InputSettings& input) {
    Settings only;
    only.inputs.push_back(input);
    return print_settings(only);
}

RunningInput::Body::Body(InputSettings given, LogFile* recording)
    : settings{std::move(given)}, log{fmt::format("input \"{}\"", settings.name)},
      tap{recording ? std::optional<LogTap>{std::in_place, settings.name, *recording} : std::nullopt}, input{parts()} {}

InputParts RunningInput::Body::parts() {
    InputParts parts;
    parts.name = settings.name;
    parts.transport = settings.transport->make(settings.transport_settings.get());
    parts.decoder = settings.decoder->make(settings.decoder_settings.get());
    parts.delay = duration_from_s(settings.delay_s);
    parts.ring = &ring;
    parts.tap = tap ? &*tap : nullptr;
    parts.on_event = [this](const InputEvent& event) { log.tell(event); };
    return parts;
}

RunningInput::RunningInput(const InputSettings& settings, std::size_t /*place*/, LogFile* recording)
    : body_{std::make_shared<Body>(settings, recording)}, thread_{[body = body_](const std::stop_token& stop) {
          name_this_thread(body->settings.name);
          body->input.run(stop);
      }} {}

std::vector<InputEntry> entries(const InputSet& inputs) {
    std::vector<InputEntry> entries;
    for (const auto& [settings, fingerprint, running] : inputs.slots())
        entries.push_back({settings.name, std::string{settings.transport->name}, std::string{settings.decoder->name},
                           running ? running->status() : nullptr});
    return entries;
}

} // namespace locus
