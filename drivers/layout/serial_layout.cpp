#include "drivers/layout/serial_layout.h"

#include "drivers/frame_decoder.h"
#include "drivers/layout/serial_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace locus::layout {
namespace {

/// A field with what its settings' words mean worked out beforehand.
struct Slot {
    explicit Slot(SerialField described)
        : field{std::move(described)}, at{static_cast<std::size_t>(field.at_byte)},
          bytes{static_cast<std::size_t>(field.bytes)}, big{field.byte_order == "big"}, si{to_si(field.unit)} {}

    SerialField field;
    std::size_t at, bytes;
    bool big;
    double si;
};

class SerialLayout : public FrameDecoder<SerialFormat> {
  public:
    explicit SerialLayout(const SerialLayoutSettings& settings)
        : FrameDecoder{SerialFormat{settings}}, settings_{settings},
          assembly_{quantities_of(settings.fields), owner_of(settings)},
          slots_{settings.fields.begin(), settings.fields.end()} {}

    void reset() override { FrameDecoder::reset(), assembly_.reset(); }

  private:
    void frame(const Frame& frame, MeasurementSink& sink) override {
        const std::size_t count = element_count(frame.bytes);
        const auto begin = static_cast<std::size_t>(settings_.element_begin_byte);
        const auto size = static_cast<std::size_t>(settings_.element_bytes);
        if (begin + count * size > frame.bytes.size()) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        for (std::size_t k = 0; k < std::max<std::size_t>(count, size == 0); ++k) {
            read(frame.bytes, false);
            if (size > 0) read(frame.bytes.subspan(begin + k * size, size), true);
            assembly_.emit(frame.begun, k, sink);
        }
    }

    std::size_t element_count(wire::Bytes frame) const {
        if (settings_.element_bytes == 0) return 0;
        if (settings_.elements > 0) return static_cast<std::size_t>(settings_.elements);
        return wire::little_bytes(frame, static_cast<std::size_t>(settings_.elements_at_byte), 1);
    }

    void read(wire::Bytes bytes, bool in_element) {
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            const Slot& slot = slots_[i];
            const SerialField& field = slot.field;
            if (field.in_element != in_element) continue;
            const std::uint64_t raw =
                slot.big ? wire::big_bytes(bytes, slot.at, slot.bytes) : wire::little_bytes(bytes, slot.at, slot.bytes);
            if (static_cast<double>(raw) == field.invalid_raw) continue;
            const double steps = value_of(raw, 8 * static_cast<unsigned>(slot.bytes), field.type);
            const double value = (steps * field.factor + field.offset) * slot.si;
            if (std::isfinite(value)) assembly_.set(i, value);
        }
    }

    SerialLayoutSettings settings_;
    Assembly assembly_;
    std::vector<Slot> slots_;
};

std::string complaint_of(const SerialField& field, const SerialLayoutSettings& layout) {
    if (auto wrong = unit_complaint(quantity_named(field.quantity), field.unit); !wrong.empty()) return wrong;
    if (field.type == "float" && field.bytes != 4) return "a float has 4 bytes";
    if (field.type == "double" && field.bytes != 8) return "a double has 8 bytes";
    const int end = field.at_byte + field.bytes;
    if (field.in_element && end > layout.element_bytes) return "it ends beyond its element (element_bytes)";
    if (!field.in_element && layout.frame_bytes > 0 && end > layout.frame_bytes)
        return "it ends beyond the frame (frame_bytes)";
    return "";
}

} // namespace

std::string check_serial_layout(const void* settings) {
    const auto& layout = *static_cast<const SerialLayoutSettings*>(settings);
    const auto sync = bytes_of_hex(layout.sync);
    if (!sync || sync->empty()) return "sync must be 1 to 16 bytes in hex, as in \"AA 25 01\"";
    if (!bytes_of_hex(layout.tail)) return "tail must be at most 16 bytes in hex, as in \"0D 0A\"";
    if (layout.fields.empty()) return "fields is empty: without it no frame means anything";
    for (std::size_t i = 0; i < layout.fields.size(); ++i)
        if (const std::string wrong = complaint_of(layout.fields[i], layout); !wrong.empty())
            return fmt::format("item {} of fields ({}): {}", i + 1, layout.fields[i].quantity, wrong);
    const std::size_t shortest = SerialFormat{layout}.shortest();
    if (layout.frame_bytes > 0 && static_cast<std::size_t>(layout.frame_bytes) < shortest)
        return fmt::format("frame_bytes is {}, but sync, checksum and tail alone need {}", layout.frame_bytes,
                           shortest);
    return "";
}

std::vector<std::uint8_t> encode(const SerialLayoutSettings& settings, std::span<const std::vector<double>> values) {
    const SerialFormat format{settings};
    const auto begin = static_cast<std::size_t>(settings.element_begin_byte);
    const auto size = static_cast<std::size_t>(settings.element_bytes);
    std::vector<std::uint8_t> frame(settings.frame_bytes > 0
                                        ? static_cast<std::size_t>(settings.frame_bytes)
                                        : std::max(format.shortest(), begin + size * values.size()) + 4);
    if (size > 0 && settings.elements == 0)
        frame[static_cast<std::size_t>(settings.elements_at_byte)] = static_cast<std::uint8_t>(values.size());
    for (std::size_t k = 0; k < values.size(); ++k)
        for (std::size_t i = 0; i < settings.fields.size(); ++i) {
            const SerialField& field = settings.fields[i];
            if ((!field.in_element && k > 0) || std::isnan(values[k][i])) continue;
            const auto count = static_cast<std::size_t>(field.bytes);
            const std::uint64_t raw =
                raw_of((values[k][i] - field.offset) / field.factor, 8 * static_cast<unsigned>(count), field.type);
            const std::size_t at = static_cast<std::size_t>(field.at_byte) + (field.in_element ? begin + k * size : 0);
            for (std::size_t b = 0; b < count; ++b)
                frame[at + (field.byte_order == "big" ? count - 1 - b : b)] = static_cast<std::uint8_t>(raw >> (8 * b));
        }
    format.seal(frame);
    return frame;
}

std::unique_ptr<Decoder> make_serial_layout(const void* settings) {
    return std::make_unique<SerialLayout>(*static_cast<const SerialLayoutSettings*>(settings));
}

} // namespace locus::layout
