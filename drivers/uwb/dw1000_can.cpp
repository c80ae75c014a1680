// DW1000 measurements in CAN frames: layout in dw1000_can.h.
#include "drivers/uwb/dw1000_can.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

namespace layout = dw1000_can;

constexpr std::uint64_t no_range = layout::length_mm.mask();
constexpr std::int64_t no_difference = -(std::int64_t{1} << (layout::length_mm.length - 1));
constexpr std::uint64_t no_power = layout::rx_power.mask();
constexpr std::uint64_t no_sigma = layout::sigma.mask();
constexpr std::uint64_t last_line_of_sight = static_cast<std::uint64_t>(LineOfSight::blocked);
constexpr double power_step_dbm = -0.5;
constexpr double sigma_step_m = 0.02;

/// Steps of a value, held to 0..last; NaN gives `unknown`.
std::uint64_t steps(double value, std::uint64_t last, std::uint64_t unknown) {
    if (std::isnan(value)) return unknown;
    return static_cast<std::uint64_t>(std::clamp(std::round(value), 0.0, static_cast<double>(last)));
}

bool fits(Address address, int offset, const CanSignal& signal) {
    return number(address) >= static_cast<std::uint64_t>(offset) &&
           number(address) - static_cast<std::uint64_t>(offset) <= signal.mask();
}

std::uint64_t place(Address address, int offset, const CanSignal& signal) {
    return signal.write(number(address) - static_cast<std::uint64_t>(offset));
}

template <class Sample>
std::uint64_t common_bits(const Sample& sample, int tag_offset, double length_mm, unsigned sequence) {
    const double sigma_steps = sample.sigma_m / sigma_step_m - 1;
    return place(sample.tag, tag_offset, layout::tag) |
           layout::length_mm.write(static_cast<std::uint64_t>(static_cast<std::int64_t>(length_mm))) |
           layout::sigma.write(steps(sigma_steps, no_sigma - 1, no_sigma)) |
           layout::line_of_sight.write(static_cast<std::uint64_t>(sample.line_of_sight)) |
           layout::sequence.write(sequence);
}

CanFrame frame(std::uint64_t word, const Dw1000CanSettings& settings, unsigned node, layout::Kind kind) {
    CanFrame frame;
    frame.id = static_cast<std::uint32_t>(settings.base_id) + layout::kinds_per_node * node + kind;
    frame.length = 8;
    for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(word >> (8 * i));
    return frame;
}

class Dw1000Can : public Decoder {
  public:
    explicit Dw1000Can(const Dw1000CanSettings& settings) : settings_(settings) {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        // Identifiers with a flag of linux/can.h set (extended, remote, error) lie far above the block.
        const std::uint32_t offset = packet.can_id - static_cast<std::uint32_t>(settings_.base_id);
        if (offset >= layout::kinds_per_node * static_cast<std::uint32_t>(settings_.nodes)) return;
        const std::uint32_t kind = offset % layout::kinds_per_node;
        if (kind > layout::range_difference) return sink.refuse(Refusal::unknown_type);
        const std::uint64_t word = can_word(packet.data);
        if (packet.data.size() != 8 || layout::line_of_sight.read(word) > last_line_of_sight)
            return sink.refuse(Refusal::malformed);
        sink.frame(packet.data);
        if (kind == layout::range)
            range(word, packet.time, sink);
        else
            difference(word, packet.time, sink);
    }

  private:
    Dw1000CanSettings settings_;

    Address address_at(const CanSignal& signal, std::uint64_t word, int offset) const {
        return address(signal.read(word) + static_cast<std::uint64_t>(offset));
    }

    template <class Sample>
    void read_common(std::uint64_t word, Sample& sample) const {
        sample.tag = address_at(layout::tag, word, settings_.tag_offset);
        if (const auto code = layout::sigma.read(word); code != no_sigma)
            sample.sigma_m = static_cast<float>(sigma_step_m * static_cast<double>(code + 1));
        sample.line_of_sight = static_cast<LineOfSight>(layout::line_of_sight.read(word));
    }

    void range(std::uint64_t word, Timestamp time, MeasurementSink& sink) const {
        const std::uint64_t mm = layout::length_mm.read(word);
        if (mm == no_range) return;
        Range range;
        read_common(word, range);
        range.anchor = address_at(layout::anchor_a, word, settings_.anchor_offset);
        range.range_m = static_cast<double>(mm) * 1e-3;
        if (const auto code = layout::rx_power.read(word); code != no_power)
            range.rx_power_dbm = static_cast<float>(power_step_dbm * static_cast<double>(code));
        sink.accept(time, range);
    }

    void difference(std::uint64_t word, Timestamp time, MeasurementSink& sink) const {
        const std::int64_t mm = layout::length_mm.read_signed(word);
        if (mm == no_difference) return;
        RangeDifference difference;
        read_common(word, difference);
        difference.anchor_a = address_at(layout::anchor_a, word, settings_.anchor_offset);
        difference.anchor_b = address_at(layout::anchor_b, word, settings_.anchor_offset);
        difference.difference_m = static_cast<double>(mm) * 1e-3;
        sink.accept(time, difference);
    }
};

} // namespace

std::optional<CanFrame> encode(const Range& range, const Dw1000CanSettings& settings, unsigned node,
                               unsigned sequence) {
    const double mm = std::round(range.range_m * 1e3);
    if (!(mm >= 0 && mm < static_cast<double>(no_range)) || !fits(range.tag, settings.tag_offset, layout::tag) ||
        !fits(range.anchor, settings.anchor_offset, layout::anchor_a))
        return std::nullopt;
    const std::uint64_t power = steps(range.rx_power_dbm / power_step_dbm, no_power - 1, no_power);
    const std::uint64_t word = common_bits(range, settings.tag_offset, mm, sequence) |
                               place(range.anchor, settings.anchor_offset, layout::anchor_a) |
                               layout::rx_power.write(power);
    return frame(word, settings, node, layout::range);
}

std::optional<CanFrame> encode(const RangeDifference& difference, const Dw1000CanSettings& settings, unsigned node,
                               unsigned sequence) {
    const double mm = std::round(difference.difference_m * 1e3);
    if (!(std::abs(mm) < -static_cast<double>(no_difference)) ||
        !fits(difference.tag, settings.tag_offset, layout::tag) ||
        !fits(difference.anchor_a, settings.anchor_offset, layout::anchor_a) ||
        !fits(difference.anchor_b, settings.anchor_offset, layout::anchor_b))
        return std::nullopt;
    const std::uint64_t word = common_bits(difference, settings.tag_offset, mm, sequence) |
                               place(difference.anchor_a, settings.anchor_offset, layout::anchor_a) |
                               place(difference.anchor_b, settings.anchor_offset, layout::anchor_b);
    return frame(word, settings, node, layout::range_difference);
}

std::unique_ptr<Decoder> make_dw1000_can(const void* settings) {
    return std::make_unique<Dw1000Can>(*static_cast<const Dw1000CanSettings*>(settings));
}

} // namespace locus::uwb
