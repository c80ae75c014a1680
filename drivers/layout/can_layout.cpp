#include "drivers/layout/can_layout.h"

#include <fmt/format.h>
#include <linux/can.h>

#include <algorithm>
#include <cmath>

namespace locus::layout {
namespace {

std::uint32_t wire_id(const CanField& field) {
    return field.extended || field.can_id > CAN_SFF_MASK ? field.can_id | CAN_EFF_FLAG : field.can_id;
}

/// A field with all that its settings say worked out beforehand.
struct Signal {
    explicit Signal(const CanField& field)
        : id{wire_id(field)}, mask{~field.can_id_ignored}, bits{field.bits()}, bytes_needed{bits.bytes_needed()},
          type{field.type}, factor{field.factor * to_si(field.unit)}, offset{field.offset * to_si(field.unit)},
          invalid_raw{field.invalid_raw}, multiplexed_by{field.multiplexed_by},
          is_multiplexor{field.quantity == quantity_names[static_cast<std::size_t>(Quantity::multiplexor)]} {}

    bool is_in(const Packet& packet) const { return (packet.can_id & mask) == (id & mask); }

    std::uint32_t id, mask;
    BitField bits;
    std::size_t bytes_needed;
    std::string type;
    double factor, offset;
    double invalid_raw;
    std::int64_t multiplexed_by;
    bool is_multiplexor;
};

class CanLayout : public Decoder {
  public:
    explicit CanLayout(const CanLayoutSettings& settings)
        : assembly_{quantities_of(settings.fields), owner_of(settings)},
          signals_{settings.fields.begin(), settings.fields.end()} {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        const auto wanted = [&](const Signal& signal) { return signal.is_in(packet); };
        if (std::ranges::none_of(signals_, wanted)) return;
        const std::int64_t multiplexor = read_multiplexor(packet);
        bool whole = true, possible = true;
        for (std::size_t i = 0; i < signals_.size(); ++i)
            if (wanted(signals_[i]) && is_there(signals_[i], multiplexor)) take(i, packet, whole, possible);
        if (!whole) return sink.refuse(Refusal::malformed);
        if (!possible) return sink.refuse(Refusal::out_of_range);
        sink.frame(packet.data);
        assembly_.emit(packet.time, 0, sink);
    }

    void reset() override { assembly_.reset(); }

  private:
    static bool is_there(const Signal& signal, std::int64_t multiplexor) {
        return !signal.is_multiplexor && (signal.multiplexed_by < 0 || signal.multiplexed_by == multiplexor);
    }

    std::int64_t read_multiplexor(const Packet& packet) const {
        for (const Signal& signal : signals_)
            if (signal.is_multiplexor && signal.is_in(packet) && packet.data.size() >= signal.bytes_needed)
                return static_cast<std::int64_t>(signal.bits.read(packet.data));
        return -1;
    }

    void take(std::size_t index, const Packet& packet, bool& whole, bool& possible) {
        const Signal& signal = signals_[index];
        if (packet.data.size() < signal.bytes_needed) return void(whole = false);
        const std::uint64_t raw = signal.bits.read(packet.data);
        if (static_cast<double>(raw) == signal.invalid_raw) return;
        const double value = value_of(raw, signal.bits.length, signal.type) * signal.factor + signal.offset;
        if (!std::isfinite(value)) return void(possible = false);
        assembly_.set(index, value);
    }

    Assembly assembly_;
    std::vector<Signal> signals_;
};

std::string complaint(const CanField& field) {
    if (auto wrong = unit_complaint(quantity_named(field.quantity), field.unit); !wrong.empty()) return wrong;
    if (field.type == "float" && field.length_bits != 32) return "a float has 32 bits";
    if (field.type == "double" && field.length_bits != 64) return "a double has 64 bits";
    if (field.bits().bytes_needed() > 64) return "it would lie beyond the 64 bytes that a frame can have";
    return "";
}

} // namespace

std::string check_can_layout(const void* settings) {
    const auto& layout = *static_cast<const CanLayoutSettings*>(settings);
    if (layout.fields.empty()) return "fields is empty: without it no frame means anything";
    for (std::size_t i = 0; i < layout.fields.size(); ++i)
        if (const std::string wrong = complaint(layout.fields[i]); !wrong.empty())
            return fmt::format("item {} of fields ({}): {}", i + 1, layout.fields[i].quantity, wrong);
    return "";
}

CanFrame encode(const CanLayoutSettings& settings, std::uint32_t can_id, std::span<const double> values) {
    CanFrame frame;
    for (std::size_t i = 0; i < settings.fields.size(); ++i) {
        const CanField& field = settings.fields[i];
        if (field.can_id != can_id || field.bits().bytes_needed() > frame.data.size() || std::isnan(values[i]))
            continue;
        frame.id = wire_id(field);
        frame.length = static_cast<std::uint8_t>(std::max<std::size_t>(frame.length, field.bits().bytes_needed()));
        const double steps = (values[i] - field.offset) / field.factor;
        field.bits().write(frame.data, raw_of(steps, static_cast<unsigned>(field.length_bits), field.type));
    }
    return frame;
}

std::unique_ptr<Decoder> make_can_layout(const void* settings) {
    return std::make_unique<CanLayout>(*static_cast<const CanLayoutSettings*>(settings));
}

} // namespace locus::layout
