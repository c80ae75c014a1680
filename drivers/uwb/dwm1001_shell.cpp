// Ranges out of the lines of a DWM1001 shell, and its waking up.
#include "drivers/uwb/dwm1001_shell.h"

#include "drivers/line_decoder.h"
#include "drivers/uwb/limits.h"
#include "drivers/wire/bytes.h"

#include <algorithm>

namespace locus::uwb {
namespace dwm1001 {
namespace {

constexpr Duration silence = std::chrono::seconds{2};
constexpr Duration shell_wakes_in = std::chrono::seconds{1};
constexpr std::string_view prompt = "dwm> ";
constexpr std::string_view enter_shell = "\r\r", stream_distances = "lec\r";

/// Asks for the stream, only ever in silence: `lec` again would stop a stream that runs.
class Waker {
  public:
    void heard() { heard_ = true; }
    void reset() { *this = {}; }

    std::string_view due(Timestamp now) {
        if (heard_ || !waiting_) wait(now, silence, enter_shell);
        if (now < due_) return {};
        const std::string_view text = next_;
        if (text == enter_shell)
            wait(now, shell_wakes_in, stream_distances);
        else
            wait(now, silence, enter_shell);
        return text;
    }

  private:
    Timestamp due_{};
    std::string_view next_;
    bool waiting_ = false;
    bool heard_ = false;

    void wait(Timestamp now, Duration duration, std::string_view next) {
        due_ = now + duration;
        next_ = next;
        waiting_ = true;
        heard_ = false;
    }
};

class Shell : public LineDecoder {
  public:
    explicit Shell(const Dwm1001ShellSettings& settings) : settings_(settings) {}

    void reset() override {
        LineDecoder::reset();
        waker_.reset();
    }

    std::optional<Packet> request(Timestamp now) override {
        if (!settings_.start_stream) return std::nullopt;
        const std::string_view text = waker_.due(now);
        if (text.empty()) return std::nullopt;
        Packet packet;
        packet.data = wire::bytes_of(text);
        return packet;
    }

  protected:
    void line(std::string_view text, Timestamp begun, MeasurementSink& sink) override {
        while (text.starts_with(prompt)) text.remove_prefix(prompt.size());
        if (text.empty()) return;
        const auto line = parse_shell_line(text);
        if (!line) return sink.refuse(Refusal::malformed);
        waker_.heard();
        sink.frame(wire::bytes_of(text));
        for (const Distance& distance : line->distances) range(distance, begun, sink);
    }

  private:
    Dwm1001ShellSettings settings_;
    Waker waker_;

    /// Zero: not measured in this cycle.
    void range(const Distance& distance, Timestamp time, MeasurementSink& sink) const {
        if (distance.distance_cm == 0) return;
        const double range_m = static_cast<double>(distance.distance_cm) * 1e-2;
        if (range_m < 0 || range_m > farthest_dw1000_m) return sink.refuse(Refusal::out_of_range);
        Range range;
        range.anchor = address(distance.anchor);
        range.tag = settings_.tag;
        range.range_m = range_m;
        sink.accept(time, range);
    }
};

} // namespace
} // namespace dwm1001

std::unique_ptr<Decoder> make_dwm1001_shell(const void* settings) {
    return std::make_unique<dwm1001::Shell>(*static_cast<const Dwm1001ShellSettings*>(settings));
}

} // namespace locus::uwb
