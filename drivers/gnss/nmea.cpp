#include "drivers/gnss/nmea.h"

#include "drivers/gnss/epoch_clock.h"
#include "drivers/gnss/nmea_epoch.h"
#include "drivers/line_decoder.h"
#include "drivers/wire/bytes.h"

#include <cmath>
#include <utility>

namespace locus::gnss {
namespace {

using namespace nmea;

class Nmea : public LineDecoder {
  public:
    explicit Nmea(const NmeaSettings& settings) : settings_{settings} {}

    void reset() override {
        LineDecoder::reset();
        epoch_ = {};
        clock_.reset();
        given_ = false;
        kinds_before_ = wanted_ = 0;
    }

  private:
    NmeaSettings settings_;
    Epoch epoch_;
    EpochClock clock_{EpochClock::day_ns};
    bool given_ = false; ///< the fix of this moment went out
    unsigned kinds_before_ = 0;
    unsigned wanted_ = 0; ///< kinds of sentence that the two moments before had: one lost sentence is still waited for

    void line(std::string_view text, Timestamp begun, MeasurementSink& sink) override {
        const auto parsed = parse_sentence(text, settings_.need_checksum);
        if (const auto* refusal = std::get_if<Refusal>(&parsed)) return sink.refuse(*refusal);
        const auto& sentence = std::get<Sentence>(parsed);
        if (sentence.type == "GGA") return add(parse_gga(sentence), text, begun, sink);
        if (sentence.type == "RMC") return add(parse_rmc(sentence), text, begun, sink);
        if (sentence.type == "VTG") return add(parse_vtg(sentence), text, begun, sink);
        if (sentence.type == "GST") return add(parse_gst(sentence), text, begun, sink);
        if (sentence.type == "ZDA") return add(parse_zda(sentence), text, begun, sink);
        if (sentence.type == "HDT") return point(parse_hdt(sentence), text, begun, sink);
        if (sentence.type == "THS") return point(parse_ths(sentence), text, begun, sink);
        sink.frame(wire::bytes_of(text));
    }

    template <class Message>
    void add(const std::optional<Message>& message, std::string_view text, Timestamp begun, MeasurementSink& sink) {
        if (!message) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        if constexpr (requires { message->time_us; }) {
            if (message->time_us == no_time) return; // a receiver that has not found the time has found no place
            if (message->time_us != epoch_.time_us()) begin(message->time_us, begun, sink);
        }
        epoch_.add(*message);
        if (wanted_ != 0 && (epoch_.kinds() & wanted_) == wanted_) give(sink);
    }

    template <class Message>
    void point(const std::optional<Message>& message, std::string_view text, Timestamp begun, MeasurementSink& sink) {
        if (!message) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        if constexpr (requires { message->mode; })
            if (message->mode != 'A') return;
        if (std::isnan(message->heading_deg)) return;
        if (message->heading_deg < 0 || message->heading_deg > 360) return sink.refuse(Refusal::out_of_range);
        sink.accept(begun, Heading{settings_.tag, message->heading_deg});
    }

    void begin(std::int64_t time_us, Timestamp begun, MeasurementSink& sink) {
        give(sink);
        wanted_ = epoch_.kinds() | std::exchange(kinds_before_, epoch_.kinds());
        epoch_ = Epoch{time_us, begun};
        given_ = false;
    }

    void give(MeasurementSink& sink) {
        if (given_) return;
        const auto fix = epoch_.fix(settings_.tag, settings_.range_error_m);
        given_ = fix.has_value();
        if (!fix) return;
        if (is_finite(*fix))
            sink.accept(time(), *fix);
        else
            sink.refuse(Refusal::out_of_range);
    }

    /// Only of moments with a fix: without one the time may be anything.
    Timestamp time() {
        if (!settings_.use_receiver_time) return epoch_.begun();
        return clock_.host_time(epoch_.time_us() * 1000, epoch_.begun());
    }

    /// NaN in a sigma says "not known"; an infinite one is nonsense.
    static bool is_finite(const GnssFix& fix) {
        return std::isfinite(fix.height_ellipsoid_m) && !std::isinf(fix.sigma_horizontal_m) &&
               !std::isinf(fix.sigma_vertical_m);
    }
};

} // namespace

std::unique_ptr<Decoder> make_nmea(const void* settings) {
    return std::make_unique<Nmea>(*static_cast<const NmeaSettings*>(settings));
}

} // namespace locus::gnss
