// UBX messages into measurements.
#include "drivers/gnss/ubx.h"

#include "drivers/frame_decoder.h"
#include "drivers/gnss/epoch_clock.h"
#include "drivers/gnss/half_cycles.h"
#include "drivers/gnss/ubx_measurements.h"

#include <cmath>

namespace locus::gnss {
namespace {

using namespace ubx;

constexpr std::int64_t ns_per_ms = 1'000'000;
constexpr std::uint8_t time_only = 5;
constexpr std::size_t relative_length_of_m8p = 40; // version 0, which tells no heading

class Ubx : public FrameDecoder<ubx::Format> {
  public:
    explicit Ubx(const UbxSettings& settings) : tag_{settings.tag}, use_receiver_time_{settings.use_receiver_time} {}

    void reset() override {
        FrameDecoder::reset();
        clock_.reset();
        half_cycles_.forget();
    }

  private:
    Address tag_;
    bool use_receiver_time_;
    EpochClock clock_{EpochClock::week_ns};
    HalfCycles half_cycles_;

    void frame(const Frame& frame, MeasurementSink& sink) override {
        const wire::Bytes payload = payload_of(frame.bytes);
        switch (message_id(frame.bytes)) {
        case NavPvt::id:
            return whole(parse_nav_pvt(payload), frame, sink);
        case RelativePosition::id:
            if (payload.size() == relative_length_of_m8p) return sink.frame(frame.bytes);
            return whole(parse_relative_position(payload), frame, sink);
        case RawEpoch::id:
            return whole(parse_raw_epoch(payload), frame, sink);
        case Subframe::id:
            return whole(parse_subframe(payload), frame, sink);
        case SensorReport::id:
            return whole(parse_sensor_report(payload), frame, sink);
        default:
            return sink.frame(frame.bytes);
        }
    }

    template <class Message>
    void whole(const std::optional<Message>& message, const Frame& frame, MeasurementSink& sink) {
        if (!message) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        give(*message, frame, sink);
    }

    /// A time that the receiver itself does not hold valid would make the clock begin anew.
    Timestamp time_of(const NavPvt& pvt, const Frame& frame) {
        if (!use_receiver_time_ || !pvt.time_valid()) return frame.begun;
        return clock_.host_time(pvt.time_of_week_ms * ns_per_ms, frame.begun);
    }

    Timestamp time_of(const RelativePosition& relative, const Frame& frame) {
        if (!use_receiver_time_) return frame.begun;
        return clock_.host_time(relative.time_of_week_ms * ns_per_ms, frame.begun);
    }

    Timestamp time_of(const RawEpoch& epoch, const Frame& frame) {
        if (!use_receiver_time_) return frame.begun;
        return clock_.host_time(std::llround(epoch.receiver_time_s * 1e9), frame.begun);
    }

    void give(const NavPvt& pvt, const Frame& frame, MeasurementSink& sink) {
        if (!pvt.fix_ok() || pvt.position_invalid() || pvt.fix_type == 0 || pvt.fix_type >= time_only) return;
        if (!possible(pvt)) return sink.refuse(Refusal::out_of_range);
        sink.accept(time_of(pvt, frame), fix_of(pvt, tag_));
    }

    void give(const RelativePosition& relative, const Frame& frame, MeasurementSink& sink) {
        if (!tells_heading(relative)) return;
        const Heading heading = heading_of(relative, tag_);
        if (!ubx::possible(heading)) return sink.refuse(Refusal::out_of_range);
        sink.accept(time_of(relative, frame), heading);
    }

    void give(const RawEpoch& epoch, const Frame& frame, MeasurementSink& sink) {
        if (!possible(epoch)) return sink.refuse(Refusal::out_of_range);
        if (epoch.signals == 0) return;
        const Timestamp time = time_of(epoch, frame);
        for (std::size_t i = 0; i < epoch.signals; ++i) {
            const RawSignal signal = parse_raw_signal(payload_of(frame.bytes), i);
            if (!signal.pseudorange_valid()) continue;
            if (possible(signal))
                sink.accept(time, with_lock(raw_of(epoch, signal, tag_), signal));
            else
                sink.refuse(Refusal::out_of_range);
        }
    }

    GnssRaw with_lock(GnssRaw raw, const RawSignal& signal) {
        if (signal.carrier_valid() && !half_cycles_.settled(raw, signal.half_cycle_known())) raw.lock_s = 0;
        return raw;
    }

    void give(const Subframe& subframe, const Frame& frame, MeasurementSink& sink) const {
        if (subframe.word_count > GnssNavigation::max_words) return; // a kind that nothing here reads
        sink.accept(frame.begun, navigation_of(subframe, tag_));
    }

    void give(const SensorReport& report, const Frame& frame, MeasurementSink& sink) const {
        for (std::size_t i = 0; i < report.count(); ++i) {
            if (report.type(i) != SensorReport::speed) continue;
            WheelSpeed wheel;
            wheel.tag = tag_;
            wheel.speed_mps = report.value(i) * 1e-3;
            sink.accept(frame.begun, wheel);
        }
    }
};

} // namespace

std::unique_ptr<Decoder> make_ubx(const void* settings) {
    return std::make_unique<Ubx>(*static_cast<const UbxSettings*>(settings));
}

} // namespace locus::gnss
