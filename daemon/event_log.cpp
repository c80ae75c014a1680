#include "daemon/event_log.h"

#include "drivers/clock.h"

#include <spdlog/spdlog.h>

namespace locus {
namespace {

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

void EventLog::tell(const InputEvent& event) {
    const auto held_back = lines_.pass(monotonic_now());
    if (!held_back.has_value()) return;
    const std::string more = held_back.value() > 0 ? fmt::format(" ({} lines held back)", held_back.value()) : "";
    spdlog::log(is_good_news(event) ? spdlog::level::info : spdlog::level::warn, "{}: {}{}", what_, sentence_of(event),
                more);
}

} // namespace locus
