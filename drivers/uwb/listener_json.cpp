// Listener lines: grammar, and what becomes of them, in listener_json.h.
#include "drivers/uwb/listener_json.h"

#include "drivers/line_decoder.h"
#include "drivers/wire/bytes.h"
#include "drivers/wire/json_scan.h"
#include "drivers/wire/text.h"
#include "fusion/uwb/ticks.h"

#include <fmt/format.h>

#include <cmath>

namespace locus::uwb {
namespace {

using wire::JsonMember;
using wire::JsonValue;

constexpr std::uint64_t clock_mask = (std::uint64_t{1} << dw1000_clock_bits) - 1;

bool read_frame(const JsonValue& value, ListenerReport& report) {
    if (value.kind != JsonValue::Kind::string || value.text.size() % 2 != 0) return false;
    if (value.text.size() / 2 > decltype(report.frame)::capacity()) return false;
    for (wire::Text hex{value.text}; !hex.done();)
        if (!hex.hex_byte(report.frame.emplace_back())) return false;
    return true;
}

/// Null, and what is no power of a radio signal, is one that is not known.
void read_power(const JsonValue& value, float& power_dbm) {
    const auto read = value.first().number<float>();
    if (read && std::isfinite(*read) && *read < 0) power_dbm = *read;
}

/// What must be there.
struct Seen {
    bool ticks = false;
    std::optional<std::size_t> length;
    std::optional<std::size_t> frame;

    bool whole() const { return ticks && frame && (!length || length == frame); }
};

bool read_member(const JsonMember& member, ListenerReport& report, Seen& seen) {
    const auto& [name, value] = member;
    if (name == "ts")
        return seen.ticks = value.first().read(report.received_ticks) && report.received_ticks <= clock_mask;
    if (name == "utime") return value.first().read(report.clock_us);
    if (name == "dlen") return value.first().read(seen.length.emplace());
    if (name == "rssi" || name == "rssi0") read_power(value, report.rx_power_dbm);
    if (name == "fppl" || name == "fppl0") read_power(value, report.first_path_power_dbm);
    if (name != "d") return true;
    if (seen.frame || !read_frame(value, report)) return false;
    seen.frame = report.frame.size();
    return true;
}

class ListenerJson : public LineDecoder {
  public:
    explicit ListenerJson(const ListenerSettings& settings) : settings_(settings) {}

  protected:
    void line(std::string_view text, Timestamp begun, MeasurementSink& sink) override {
        const auto report = parse_listener_report(text);
        if (!report) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        const std::span<const std::uint8_t> frame{report->frame.data(), report->frame.size()};
        if (const auto blink = ieee802154::parse_blink(frame)) sink.accept(begun, arrival(*report, *blink));
        const auto sync = ieee802154::parse_clock_calibration(frame);
        if (sync && sync->repetition == 0) sink.accept(begun, clock_sync(*report, *sync));
    }

  private:
    ListenerSettings settings_;

    Arrival arrival(const ListenerReport& report, const ieee802154::Blink& blink) const {
        return {settings_.anchor, address(blink.eui),  report.received_ticks,
                blink.sequence,   report.rx_power_dbm, report.first_path_power_dbm};
    }
    ClockSync clock_sync(const ListenerReport& report, const ieee802154::ClockCalibration& sync) const {
        return {address(sync.eui), settings_.anchor, sync.sent_ticks_in_master & clock_mask, report.received_ticks,
                sync.sequence};
    }
};

std::string power_member(std::string_view name, float power_dbm) {
    return std::isnan(power_dbm) ? "" : fmt::format(R"("{}":{:.1f},)", name, power_dbm);
}

} // namespace

std::optional<ListenerReport> parse_listener_report(std::string_view line) {
    wire::JsonObject object{line};
    ListenerReport report;
    Seen seen;
    for (JsonMember member; object.next(member);)
        if (!read_member(member, report, seen)) return std::nullopt;
    return object.whole() && seen.whole() ? std::optional{report} : std::nullopt;
}

std::string encode(const ListenerReport& report) {
    std::string line = fmt::format(R"({{"utime":{},"ts":{},)", report.clock_us, report.received_ticks);
    line += power_member("rssi", report.rx_power_dbm) + power_member("fppl", report.first_path_power_dbm);
    line += fmt::format(R"("dlen":{},"d":")", report.frame.size());
    for (const std::uint8_t byte : report.frame) line += fmt::format("{:02x}", byte);
    return line + "\"}\r\n";
}

std::unique_ptr<Decoder> make_listener_json(const void* settings) {
    return std::make_unique<ListenerJson>(*static_cast<const ListenerSettings*>(settings));
}

} // namespace locus::uwb
