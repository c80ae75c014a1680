#include "drivers/uwb/cwru_can.h"

#include "drivers/uwb/limits.h"
#include "drivers/wire/bytes.h"

#include <linux/can.h>

#include <bit>

namespace locus::uwb {
namespace {

constexpr std::size_t older_length = 8, newer_length = 6;
constexpr std::uint8_t newer_distance = 4; ///< kind; others are positions, times, powers

bool has_known_length(const Packet& packet) {
    return packet.data.size() == older_length || packet.data.size() == newer_length;
}

class CwruCan : public Decoder {
  public:
    explicit CwruCan(const CwruSettings& settings) : settings_{settings} {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        if (packet.can_id != static_cast<std::uint32_t>(settings_.node)) return; // a question has its RTR bit set
        if (!has_known_length(packet)) return sink.refuse(Refusal::malformed);
        sink.frame(packet.data);
        const auto distance = parse_cwru(packet.data);
        if (!distance) return;
        // Written so that a NaN is refused as well.
        if (!(distance->distance_m > 0 && distance->distance_m < farthest_dw1000_m))
            return sink.refuse(Refusal::out_of_range);
        Range range;
        range.anchor = address(distance->anchor + static_cast<unsigned>(settings_.anchor_offset));
        range.tag = settings_.tag;
        range.range_m = distance->distance_m;
        sink.accept(packet.time, range);
    }

    std::optional<Packet> request(Timestamp now) override {
        if (settings_.poll_period_s <= 0 || now < next_) return std::nullopt;
        next_ = now + duration_from_s(settings_.poll_period_s);
        question_ = {static_cast<std::uint32_t>(settings_.node) | CAN_RTR_FLAG, older_length, {}};
        return question_.packet(now);
    }

  private:
    CwruSettings settings_;
    Timestamp next_{};
    CanFrame question_;
};

} // namespace

std::optional<CwruDistance> parse_cwru(std::span<const std::uint8_t> data) {
    if (data.size() == older_length) return CwruDistance{data[1], wire::little<float>(data, 2)};
    if (data.size() == newer_length && data[1] == newer_distance)
        return CwruDistance{data[0], wire::little<float>(data, 2)};
    return std::nullopt;
}

CanFrame encode(const CwruDistance& distance, int node, bool newer) {
    const auto word =
        std::uint64_t{std::bit_cast<std::uint32_t>(distance.distance_m)} << 16 |
        (newer ? std::uint64_t{newer_distance} << 8 | distance.anchor : std::uint64_t{distance.anchor} << 8);
    CanFrame frame{
        static_cast<std::uint32_t>(node), static_cast<std::uint8_t>(newer ? newer_length : older_length), {}};
    for (std::size_t i = 0; i < frame.data.size(); ++i) frame.data[i] = static_cast<std::uint8_t>(word >> (8 * i));
    return frame;
}

std::unique_ptr<Decoder> make_cwru_can(const void* settings) {
    return std::make_unique<CwruCan>(*static_cast<const CwruSettings*>(settings));
}

} // namespace locus::uwb
