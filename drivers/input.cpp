#include "drivers/input.h"

#include "drivers/clock.h"
#include "drivers/stoppable_sleep.h"

namespace locus {
namespace {

constexpr Duration read_timeout = std::chrono::milliseconds{100};

void count(InputStatus::Counter& counter, std::uint64_t more = 1) {
    counter.fetch_add(more, std::memory_order_relaxed);
}

} // namespace

void Input::run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        if (open() && read_until_lost(stop) == ReadStatus::ended) return;
        if (!stop.stop_requested()) sleep_unless_stopped(stop, back_off_.next());
    }
    parts_.transport->close();
    status_.state = InputState::stopped;
}

bool Input::open() {
    if (!parts_.transport->open()) {
        fail(InputEvent::Kind::unavailable, parts_.transport->last_error());
        return false;
    }
    if (parts_.decoder) parts_.decoder->reset();
    if (was_open_) count(status_.reconnects);
    was_open_ = true;
    in_step_ = false;
    told_.clear();
    status_.trouble.set({});
    status_.state = InputState::open;
    emit(InputEvent::Kind::opened, {});
    return true;
}

ReadStatus Input::read_until_lost(const std::stop_token& stop) {
    ReadStatus result = ReadStatus::ok;
    while (result == ReadStatus::ok && !stop.stop_requested()) {
        result = parts_.transport->read(*this, read_timeout);
        copy_counters();
        if (result != ReadStatus::ok) break;
        tell_trouble();
        ask_device();
    }
    if (result == ReadStatus::lost) fail(InputEvent::Kind::lost, parts_.transport->last_error());
    parts_.transport->close();
    if (result == ReadStatus::ended) {
        status_.state = InputState::ended;
        emit(InputEvent::Kind::ended, {});
    }
    return result;
}

/// What could not be written is not tried again: the decoder asks anew when no answer comes.
void Input::ask_device() const {
    if (!parts_.decoder) return;
    if (const auto request = parts_.decoder->request(monotonic_now())) parts_.transport->write(*request);
}

void Input::fail(InputEvent::Kind kind, std::string_view text) {
    status_.state = InputState::waiting;
    if (text == told_) return;
    note_trouble(text);
    emit(kind, text);
}

void Input::note_trouble(std::string_view text) {
    told_ = text;
    status_.trouble.set(text);
    if (text.empty()) return;
    status_.last_error.set(text);
    status_.last_error_ns = to_ns(monotonic_now());
}

void Input::copy_counters() {
    status_.kernel_dropped.store(parts_.transport->kernel_dropped(), std::memory_order_relaxed);
    status_.wire_errors.store(parts_.transport->wire_errors(), std::memory_order_relaxed);
}

void Input::tell_trouble() {
    const std::string_view trouble = parts_.transport->trouble();
    if (trouble == told_) return;
    note_trouble(trouble);
    emit(InputEvent::Kind::trouble, trouble);
}

void Input::emit(InputEvent::Kind kind, std::string_view text) const {
    if (parts_.on_event) parts_.on_event({kind, text});
}

void Input::packet(const Packet& packet) {
    back_off_.reset(); // not at open(): a device that opens but says nothing and falls away must not spin
    count(status_.packets);
    count(status_.bytes, packet.data.size());
    status_.last_packet_ns.store(to_ns(packet.time), std::memory_order_relaxed);
    if (parts_.tap) parts_.tap->packet(packet);
    if (parts_.decoder) parts_.decoder->decode(packet, *this);
}

void Input::accept(Timestamp time, const Observation& observation) {
    count(status_.measurements);
    if (!parts_.ring) return;
    if (!parts_.ring->push({time - parts_.delay, sequence_++, parts_.index, observation})) count(status_.ring_dropped);
}

void Input::frame(std::span<const std::uint8_t> /*bytes*/) {
    count(status_.frames);
    in_step_ = true;
}

void Input::refuse(Refusal reason) {
    count(status_.refused[static_cast<std::size_t>(reason)]);
    if (!is_damage(reason)) return;
    if (in_step_) count(status_.resyncs);
    in_step_ = false;
}

} // namespace locus
