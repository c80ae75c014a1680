#include "drivers/uwb/loco_sniffer.h"

#include "drivers/device_clock.h"
#include "drivers/frame_decoder.h"
#include "drivers/uwb/loco_tdoa.h"
#include "fusion/uwb/ticks.h"

#include <algorithm>

namespace locus::uwb {
namespace {

/// Lines of text and binary records, told apart by their first byte.
struct LocoFormat {
    static constexpr std::size_t max_length = 320;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] == 'F') return look_at_line(bytes);
        return bytes[0] == 0xBC ? look_at_record(bytes) : Look::none(Refusal::garbage);
    }

  private:
    static Look look_at_line(wire::Bytes bytes) {
        constexpr std::string_view begin = "From ";
        const auto compared = std::min(begin.size(), bytes.size());
        if (!std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(compared), begin.begin()))
            return Look::none(Refusal::garbage);
        bytes = bytes.first(std::min(bytes.size(), max_length)); // whatever more has come: a longer line is none
        const auto end = std::ranges::find_if(bytes, [](std::uint8_t c) { return c < ' ' || c > '~'; });
        if (end == bytes.end())
            return bytes.size() < max_length ? Look::need(bytes.size() + 1) : Look::none(Refusal::too_long);
        const auto length = static_cast<std::size_t>(end - bytes.begin());
        if (*end == '\n') return Look::frame(length + 1);
        if (*end != '\r') return Look::none(Refusal::garbage);
        if (length + 1 == bytes.size()) return Look::need(bytes.size() + 1);
        return bytes[length + 1] == '\n' ? Look::frame(length + 2) : Look::none(Refusal::garbage);
    }

    static Look look_at_record(wire::Bytes bytes) {
        constexpr std::size_t head = 10;
        if (bytes.size() < head) return Look::need(head);
        const std::size_t payload = wire::little<std::uint16_t>(bytes, 8);
        if (payload > loco::longest_payload) return Look::none(Refusal::too_long);
        const std::size_t length = head + payload + 2;
        if (bytes.size() < length) return Look::need(length);
        return loco::parse_record(bytes.first(length)) ? Look::frame(length) : Look::none(Refusal::malformed);
    }
};

class LocoSniffer : public FrameDecoder<LocoFormat> {
  public:
    explicit LocoSniffer(const LocoSnifferSettings& settings) : settings_{settings} {}

    void reset() override {
        FrameDecoder::reset();
        differences_.reset();
        clock_.reset();
    }

  private:
    void frame(const Frame& frame, MeasurementSink& sink) override {
        const auto sniffed = frame.bytes[0] == 'F' ? line(frame.bytes) : loco::parse_record(frame.bytes);
        if (!sniffed) return sink.refuse(Refusal::malformed);
        const auto payload = loco::parse(sniffed->payload);
        if (!payload) return sink.refuse(Refusal::unknown_type);
        sink.frame(frame.bytes);
        const Timestamp time = clock_.host_time(sniffed->rx_ticks, frame.begun);
        auto difference = differences_.hear(sniffed->from, sniffed->rx_ticks, *payload);
        if (!difference) return;
        difference->tag = settings_.tag;
        difference->anchor_a = named(difference->anchor_a);
        difference->anchor_b = named(difference->anchor_b);
        sink.accept(time, *difference);
    }

    std::optional<loco::Sniffed> line(wire::Bytes bytes) {
        std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
        while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
        return loco::parse_line(text, payload_);
    }

    Address named(Address anchor) const {
        return address(number(anchor) + static_cast<std::uint64_t>(settings_.anchor_offset));
    }

    LocoSnifferSettings settings_;
    loco::DifferenceMaker differences_;
    DeviceClock clock_{tick_s, dw1000_clock_bits};
    std::array<std::uint8_t, loco::longest_payload> payload_{};
};

} // namespace

std::unique_ptr<Decoder> make_loco_sniffer(const void* settings) {
    return std::make_unique<LocoSniffer>(*static_cast<const LocoSnifferSettings*>(settings));
}

} // namespace locus::uwb
