// Asks a DWM1001 for its distances, and makes ranges of what it answers.
#include "drivers/uwb/dwm1001_tlv.h"

#include "drivers/frame_decoder.h"
#include "drivers/uwb/limits.h"

#include <algorithm>

namespace locus::uwb {
namespace dwm1001 {
namespace {

constexpr Duration longest_wait = std::chrono::milliseconds{200}; // for an answer (protocols.md 1(b))
constexpr Duration longest_gap = longest_wait / 2;                // inside an answer, which takes 6 ms
constexpr std::array<std::uint8_t, 2> loc_get{0x0C, 0x00};

class Tlv : public FrameDecoder<TlvFormat> {
  public:
    explicit Tlv(const Dwm1001TlvSettings& settings)
        : settings_(settings),
          period_(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(settings.poll_period_s))) {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        if (flush_ || packet.time - last_ > longest_gap) flush(sink);
        last_ = packet.time;
        FrameDecoder::decode(packet, sink);
    }

    std::optional<Packet> request(Timestamp now) override {
        if (asked_ && now - *asked_ < (answered_ ? period_ : std::max(period_, longest_wait))) return std::nullopt;
        flush_ = !answered_;
        asked_ = now;
        answered_ = false;
        Packet packet;
        packet.data = loc_get;
        return packet;
    }

    void reset() override {
        FrameDecoder::reset();
        asked_.reset();
    }

  private:
    Dwm1001TlvSettings settings_;
    Duration period_;
    std::optional<Timestamp> asked_;
    Timestamp last_{};
    bool answered_ = false;
    bool flush_ = false;

    /// Half an answer, whose rest will not come. A position without distances has no other end than this.
    void flush(MeasurementSink& sink) {
        flush_ = false;
        if (waiting().size() == dwm1001::position_reply_size)
            sink.frame(waiting());
        else if (!waiting().empty())
            sink.refuse(Refusal::malformed);
        FrameDecoder::reset();
    }

    void frame(const Frame& frame, MeasurementSink& sink) override {
        answered_ = true;
        const auto reply = parse_tlv_reply(frame.bytes);
        if (!reply) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        for (const TlvDistance& distance : reply->distances) range(reply->from, distance, frame.begun, sink);
    }

    void range(TlvReply::From from, const TlvDistance& distance, Timestamp time, MeasurementSink& sink) const {
        const bool of_tag = from == TlvReply::From::tag;
        Range range;
        range.anchor = of_tag ? address(distance.address) : settings_.anchor;
        range.tag = of_tag ? settings_.tag : address(distance.address);
        range.range_m = distance.distance_mm * 1e-3;
        if (range.range_m > farthest_dw1000_m) return sink.refuse(Refusal::out_of_range);
        if (distance.distance_mm > 0) sink.accept(time, range); // zero: not measured
    }
};

} // namespace
} // namespace dwm1001

std::unique_ptr<Decoder> make_dwm1001_tlv(const void* settings) {
    return std::make_unique<dwm1001::Tlv>(*static_cast<const Dwm1001TlvSettings*>(settings));
}

} // namespace locus::uwb
