// RoboMaster UWB records out of three CAN frames.
#include "drivers/uwb/robomaster_can.h"

#include <algorithm>

namespace locus::uwb {
namespace {

constexpr std::array<std::size_t, 3> frame_sizes{8, 8, 6};
constexpr Duration longest_gap = std::chrono::milliseconds{10}; // as the vendor's own receiver has it

class RobomasterCan : public Decoder {
  public:
    explicit RobomasterCan(const RobomasterSettings& settings) : settings_(settings) {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        if (packet.can_id != static_cast<std::uint32_t>(settings_.id)) return;
        if (part_ > 0 && packet.time - last_ > longest_gap) give_up(sink);
        last_ = packet.time;
        // Eight bytes where six are due: the end of the last record was lost, and this begins the next.
        if (part_ == 2 && packet.data.size() == 8) give_up(sink);
        if (packet.data.size() != frame_sizes[part_]) return give_up(sink);
        if (part_ == 0) begun_ = packet.time;
        std::copy(packet.data.begin(), packet.data.end(), record_.begin() + static_cast<std::ptrdiff_t>(8 * part_));
        if (++part_ < frame_sizes.size()) return;
        part_ = 0;
        sink.frame(record_);
        ranges(sink);
    }

    void reset() override { part_ = 0; }

  private:
    RobomasterSettings settings_;
    std::array<std::uint8_t, robomaster_record_size> record_{};
    std::size_t part_ = 0; ///< frame that is due
    Timestamp begun_{};
    Timestamp last_{};

    void give_up(MeasurementSink& sink) {
        part_ = 0;
        sink.refuse(Refusal::malformed);
    }

    void ranges(MeasurementSink& sink) const {
        const auto distances_cm = parse_robomaster_record(record_).distance_cm;
        for (unsigned i = 0; i < distances_cm.size(); ++i) {
            if (distances_cm[i] < 0) sink.refuse(Refusal::out_of_range);
            if (distances_cm[i] <= 0) continue;
            Range range;
            range.anchor = address(i + static_cast<unsigned>(settings_.anchor_offset));
            range.tag = address(static_cast<unsigned>(settings_.tag));
            range.range_m = distances_cm[i] * 1e-2;
            sink.accept(begun_, range);
        }
    }
};

} // namespace

RobomasterRecord parse_robomaster_record(std::span<const std::uint8_t, robomaster_record_size> bytes) {
    const auto word = [&](std::size_t i) { return static_cast<std::int16_t>(bytes[2 * i] | bytes[2 * i + 1] << 8); };
    RobomasterRecord record{word(0), word(1), static_cast<std::uint16_t>(word(2)), {}, 0};
    for (std::size_t i = 0; i < record.distance_cm.size(); ++i) record.distance_cm[i] = word(3 + i);
    record.error = static_cast<std::uint16_t>(word(9));
    return record;
}

std::array<CanFrame, 3> encode(const RobomasterRecord& record, const RobomasterSettings& settings) {
    const auto& d = record.distance_cm;
    const std::array<int, robomaster_record_size / 2> words{
        record.x_cm, record.y_cm, record.yaw, d[0], d[1], d[2], d[3], d[4], d[5], record.error, 0};
    std::array<CanFrame, 3> frames{};
    for (std::size_t part = 0; part < frames.size(); ++part) {
        frames[part].id = static_cast<std::uint32_t>(settings.id);
        frames[part].length = static_cast<std::uint8_t>(frame_sizes[part]);
        for (std::size_t i = 0; i < frame_sizes[part]; ++i)
            frames[part].data[i] = static_cast<std::uint8_t>(words[4 * part + i / 2] >> (8 * (i % 2)));
    }
    return frames;
}

std::unique_ptr<Decoder> make_robomaster_can(const void* settings) {
    return std::make_unique<RobomasterCan>(*static_cast<const RobomasterSettings*>(settings));
}

} // namespace locus::uwb
