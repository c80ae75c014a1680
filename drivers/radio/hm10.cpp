#include "drivers/radio/hm10.h"

#include "drivers/frame_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace locus::radio {
namespace {

constexpr std::string_view prefix = "OK+DISC:";
constexpr std::size_t record_size = 78;
constexpr std::string_view scan_begins = "OK+DISIS", scan_ends = "OK+DISCE";

std::string_view text_of(wire::Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

bool all_hex(std::string_view text) {
    return std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F'); });
}

/// Colons and hex digits where a record has them, and its strength a minus and three digits.
bool has_shape(std::string_view record) {
    for (const std::size_t colon : {7, 16, 49, 60, 73})
        if (record[colon] != ':') return false;
    return all_hex(record.substr(8, 8)) && all_hex(record.substr(17, 32)) && all_hex(record.substr(50, 10)) &&
           all_hex(record.substr(61, 12)) && record[74] == '-' &&
           std::ranges::all_of(record.substr(75, 3), [](char c) { return c >= '0' && c <= '9'; });
}

template <class Number>
Number digits(std::string_view text, int base) {
    Number number{};
    std::from_chars(text.data(), text.data() + text.size(), number, base);
    return number;
}

struct Hm10Format {
    static constexpr std::size_t max_length = record_size;

    Look look(wire::Bytes bytes) const {
        const std::string_view text = text_of(bytes);
        const std::size_t known = std::min(text.size(), prefix.size());
        const auto begins = [&](std::string_view word) { return text.substr(0, known) == word.substr(0, known); };
        if (!begins(prefix) && !begins(scan_begins) && !begins(scan_ends)) return Look::none(Refusal::garbage);
        if (known < prefix.size()) return Look::need(prefix.size());
        if (!begins(prefix)) return Look::frame(prefix.size());
        if (text.size() < record_size) return Look::need(record_size);
        return has_shape(text.substr(0, record_size)) ? Look::frame(record_size) : Look::none(Refusal::malformed);
    }
};

class Hm10 : public FrameDecoder<Hm10Format> {
  public:
    explicit Hm10(const Hm10Settings& settings) : settings_{settings} {}

    std::optional<Packet> request(Timestamp now) override {
        const auto period = duration_from_s(settings_.scan_period_s);
        if (period <= Duration::zero() || now < next_scan_) return std::nullopt;
        next_scan_ = now + period;
        Packet packet;
        packet.data = wire::bytes_of(scan);
        return packet;
    }

  private:
    static constexpr std::string_view scan = "AT+DISI?";

    void frame(const Frame& frame, MeasurementSink& sink) override {
        sink.frame(frame.bytes);
        if (frame.bytes.size() != record_size) return;
        const std::string_view record = text_of(frame.bytes);
        SignalStrength strength;
        strength.transmitter = address(digits<std::uint64_t>(record.substr(61, 12), 16));
        strength.receiver = settings_.receiver;
        strength.rssi_dbm = -static_cast<float>(digits<int>(record.substr(75, 3), 10));
        const auto power = digits<std::uint8_t>(record.substr(58, 2), 16);
        if (record.substr(8, 8) == "4C000215") strength.tx_power_dbm = static_cast<std::int8_t>(power);
        if (strength.rssi_dbm < 0) sink.accept(frame.begun, strength); // 000: the module does not know
    }

    Hm10Settings settings_;
    Timestamp next_scan_{};
};

} // namespace

std::optional<Hm10Record> parse_hm10_record(std::string_view text) {
    if (text.size() != record_size || !text.starts_with(prefix) || !has_shape(text)) return std::nullopt;
    return Hm10Record{std::string{text.substr(8, 8)},
                      std::string{text.substr(17, 32)},
                      digits<std::uint16_t>(text.substr(50, 4), 16),
                      digits<std::uint16_t>(text.substr(54, 4), 16),
                      static_cast<std::int8_t>(digits<std::uint8_t>(text.substr(58, 2), 16)),
                      digits<std::uint64_t>(text.substr(61, 12), 16),
                      -digits<int>(text.substr(75, 3), 10)};
}

std::string encode(const Hm10Record& record) {
    return fmt::format("OK+DISC:{}:{}:{:04X}{:04X}{:02X}:{:012X}:-{:03}", record.factory_id, record.uuid, record.major,
                       record.minor, static_cast<std::uint8_t>(record.tx_power_dbm), record.mac, -record.rssi_dbm);
}

std::unique_ptr<Decoder> make_hm10(const void* settings) {
    return std::make_unique<Hm10>(*static_cast<const Hm10Settings*>(settings));
}

} // namespace locus::radio
