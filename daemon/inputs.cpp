#include "daemon/inputs.h"

#include "config/load.h"
#include "drivers/clock.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace locus {
namespace {

/// Every value as text, also the defaults.
std::string fingerprint_of(const InputSettings& input) {
    Settings only;
    only.inputs.push_back(input);
    return print_settings(only);
}

std::string sentence_of(const InputEvent& event) {
    switch (event.kind) {
    case InputEvent::Kind::opened:
        return "open";
    case InputEvent::Kind::unavailable:
        return fmt::format("cannot be opened: {}", event.text);
    case InputEvent::Kind::lost:
        return fmt::format("lost: {}", event.text);
    case InputEvent::Kind::trouble:
        return event.text.empty() ? "well again" : std::string{event.text};
    case InputEvent::Kind::ended:
        return "read to its end";
    }
    return {};
}

bool is_good_news(const InputEvent& event) {
    return event.kind == InputEvent::Kind::opened || event.kind == InputEvent::Kind::ended || event.text.empty();
}

} // namespace

RunningInput::Body::Body(InputSettings given, LogFile* recording)
    : settings{std::move(given)},
      tap{recording ? std::optional<LogTap>{std::in_place, settings.name, *recording} : std::nullopt}, input{parts()} {}

InputParts RunningInput::Body::parts() {
    InputParts parts;
    parts.name = settings.name;
    parts.transport = settings.transport->make(settings.transport_settings.get());
    parts.decoder = settings.decoder->make(settings.decoder_settings.get());
    parts.delay = duration_from_s(settings.delay_s);
    parts.ring = &ring;
    parts.tap = tap ? &*tap : nullptr;
    parts.on_event = [this](const InputEvent& event) { log(event); };
    return parts;
}

/// In the input's thread.
void RunningInput::Body::log(const InputEvent& event) {
    const auto held_back = lines.pass(monotonic_now());
    if (!held_back) return;
    const std::string more = *held_back ? fmt::format(" ({} lines held back)", *held_back) : "";
    spdlog::log(is_good_news(event) ? spdlog::level::info : spdlog::level::warn, "input \"{}\": {}{}", settings.name,
                sentence_of(event), more);
}

RunningInput::RunningInput(const InputSettings& settings, LogFile* recording)
    : body_{std::make_shared<Body>(settings, recording)}, thread_{[body = body_](const std::stop_token& stop) {
          name_this_thread(body->settings.name);
          body->input.run(stop);
      }} {}

/// Takes over from `before` the inputs whose settings are the same; the others' slots are left empty.
std::vector<InputSet::Slot> InputSet::keep_unchanged(std::vector<Slot>& before,
                                                     const std::vector<InputSettings>& wanted) {
    std::vector<Slot> slots;
    for (const InputSettings& settings : wanted) {
        Slot slot{settings, fingerprint_of(settings), nullptr};
        const auto same = std::ranges::find(before, slot.fingerprint, &Slot::fingerprint);
        if (same != before.end()) slot.running = std::move(same->running);
        slots.push_back(std::move(slot));
    }
    return slots;
}

void InputSet::apply(const std::vector<InputSettings>& wanted, int priority) {
    std::vector<Slot> slots = keep_unchanged(slots_, wanted);
    stop(slots_); // before the new ones start: they may want the same device
    for (Slot& slot : slots)
        if (!slot.running && slot.settings.enabled)
            slot.running = std::make_unique<RunningInput>(slot.settings, recording_);
    for (const Slot& slot : slots)
        if (slot.running) slot.running->schedule(priority);
    slots_ = std::move(slots);
}

void InputSet::stop(std::vector<Slot>& slots) {
    for (const Slot& slot : slots)
        if (slot.running) slot.running->request_stop();
    slots.clear();
}

void InputSet::stop() { stop(slots_); }

std::vector<PlannedInput> InputSet::planned() const {
    std::vector<PlannedInput> inputs;
    for (std::size_t i = 0; i < slots_.size(); ++i)
        if (slots_[i].running) inputs.push_back({slots_[i].running->ring(), static_cast<std::uint16_t>(i)});
    return inputs;
}

std::vector<InputEntry> InputSet::entries() const {
    std::vector<InputEntry> entries;
    for (const auto& [settings, fingerprint, running] : slots_)
        entries.push_back({settings.name, std::string{settings.transport->name}, std::string{settings.decoder->name},
                           running ? running->status() : nullptr});
    return entries;
}

bool InputSet::all_tried() const {
    return std::ranges::none_of(
        slots_, [](const Slot& slot) { return slot.running && slot.running->status()->state == InputState::starting; });
}

std::size_t InputSet::open() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        slots_, [](const Slot& slot) { return slot.running && slot.running->status()->state == InputState::open; }));
}

} // namespace locus
