#include "drivers/gnss/rtcm3.h"

#include "drivers/frame_decoder.h"
#include "drivers/gnss/rtcm3_frame.h"
#include "drivers/gnss/rtcm3_msm.h"
#include "fusion/geometry/vector.h"

namespace locus::gnss {
namespace {

using namespace rtcm3;

/// On the ground or near it: what else the coordinates may say is no place of a base.
bool possible(const AntennaPlace& place) {
    constexpr double lowest_m = 6.3e6, highest_m = 6.4e6;
    const double radius_m = vector(place.position_ecef_m).norm();
    return radius_m > lowest_m && radius_m < highest_m;
}

class Rtcm3 : public FrameDecoder<rtcm3::Format> {
  public:
    void reset() override {
        FrameDecoder::reset();
        place_.reset();
    }

  private:
    std::optional<AntennaPlace> place_;

    void frame(const Frame& frame, MeasurementSink& sink) override {
        const wire::Bytes message = message_of(frame.bytes);
        const unsigned number = number_of(message);
        if (is_place(number)) return hear(parse_place(message), frame, sink);
        if (is_gps_extended(number)) return hear(parse_gps(message), frame, sink);
        if (is_msm(number)) return hear(parse_msm(message), frame, sink);
        sink.frame(frame.bytes);
    }

    void hear(const std::optional<AntennaPlace>& place, const Frame& frame, MeasurementSink& sink) {
        if (!place) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        if (!possible(*place)) return sink.refuse(Refusal::out_of_range);
        place_ = place;
    }

    void hear(const Reading& reading, const Frame& frame, MeasurementSink& sink) const {
        if (reading.malformed) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        if (!reading.epoch) return sink.refuse(Refusal::out_of_range);
        for (const Signal& signal : reading.epoch->heard()) sink.accept(frame.begun, range_of(*reading.epoch, signal));
    }

    GnssBaseRange range_of(const rtcm3::Epoch& epoch, const Signal& signal) const {
        GnssBaseRange range;
        range.base = address(epoch.station);
        range.time_s_in_gps_week = epoch.time_s_in_gps_week;
        range.pseudorange_m = signal.pseudorange_m;
        if (place_ && place_->station == epoch.station) range.antenna_ecef_m = place_->position_ecef_m;
        range.carrier_to_noise_dbhz = signal.carrier_to_noise_dbhz;
        range.constellation = epoch.constellation;
        range.satellite = signal.satellite;
        range.signal = signal.signal;
        range.glonass_slot = signal.glonass_slot;
        return range;
    }
};

} // namespace

std::unique_ptr<Decoder> make_rtcm3(const void* /*settings*/) { return std::make_unique<Rtcm3>(); }

} // namespace locus::gnss
