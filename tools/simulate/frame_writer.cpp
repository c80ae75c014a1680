#include "tools/simulate/frame_writer.h"

#include "drivers/uwb/dw1000_can.h"
#include "drivers/uwb/trek1000.h"

#include <algorithm>

namespace locus::simulate {
namespace {

template <class Settings>
const Settings& decoder_settings(const Sensor& sensor) {
    return *static_cast<const Settings*>(sensor.input.decoder_settings.get());
}

/// The number that the device itself has, before the configuration's offset is added.
std::uint64_t device_number(Address address, int offset) {
    return number(address) - static_cast<std::uint64_t>(offset);
}

bool all_below(const auto& items, std::uint64_t limit, auto device_number_of) {
    return std::ranges::all_of(items, [&](const auto& item) { return device_number_of(item) < limit; });
}

std::string bad_numbers(const Scenario& scenario, int anchor_offset, int tag_offset, std::uint64_t anchor_limit) {
    constexpr std::uint64_t tag_limit = 65536;
    const auto of_anchor = [&](const Anchor& anchor) { return device_number(anchor.address, anchor_offset); };
    const auto of_mover = [&](const Mover& mover) { return device_number(mover.target.address, tag_offset); };
    if (!all_below(scenario.site.anchors, anchor_limit, of_anchor))
        return "addresses of anchors, less anchor_offset, must be below " + std::to_string(anchor_limit);
    if (!all_below(scenario.movers, tag_limit, of_mover))
        return "addresses of targets, less tag_offset, must be below " + std::to_string(tag_limit);
    return {};
}

std::string cannot_write_trek(const Scenario& scenario, const Sensor& sensor) {
    if (sensor.radio.mode != "ranges") return "trek1000 has ranges only: use mode: ranges, or decoder: dw1000_can";
    const auto& settings = decoder_settings<uwb::TrekSettings>(sensor);
    return bad_numbers(scenario, settings.anchor_offset, settings.tag_offset, uwb::TrekReport::max_ranges);
}

std::string cannot_write_can(const Scenario& scenario, const Sensor& sensor) {
    const auto& settings = decoder_settings<uwb::Dw1000CanSettings>(sensor);
    return bad_numbers(scenario, settings.anchor_offset, settings.tag_offset, 256);
}

/// One `mc` line an epoch, with as many columns as the site needs.
class TrekWriter : public FrameWriter {
  public:
    TrekWriter(const Scenario& scenario, const uwb::TrekSettings& settings) : settings_(settings) {
        constexpr std::uint64_t usual_columns = 4;
        columns_ = usual_columns;
        for (const Anchor& anchor : scenario.site.anchors)
            columns_ = std::max(columns_, device_number(anchor.address, settings.anchor_offset) + 1);
    }

    void write(const Epoch& epoch, PacketSink& out) override {
        uwb::TrekReport report;
        report.columns = static_cast<std::uint8_t>(columns_);
        for (const Observation& observation : epoch.observations) {
            const auto& range = std::get<Range>(observation);
            const auto column = device_number(range.anchor, settings_.anchor_offset);
            report.mask |= 1u << column;
            report.range_mm[column] = static_cast<std::int32_t>(range.range_m * 1e3);
        }
        report.long_count = ++lines_;
        report.sequence = static_cast<std::uint8_t>(epoch.sequence);
        report.debug = static_cast<std::uint32_t>(static_cast<std::int64_t>(epoch.device_s * 1e3));
        report.tag = static_cast<std::uint16_t>(device_number(epoch.tag, settings_.tag_offset));
        const std::string line = encode(report);
        Packet packet;
        packet.time = epoch.arrival;
        packet.data = {reinterpret_cast<const std::uint8_t*>(line.data()), line.size()};
        out.packet(packet);
    }

  private:
    uwb::TrekSettings settings_;
    std::uint64_t columns_ = 0;
    std::uint16_t lines_ = 0;
};

/// One frame a measurement, all from node 0.
class CanWriter : public FrameWriter {
  public:
    explicit CanWriter(const uwb::Dw1000CanSettings& settings) : settings_(settings) {}

    void write(const Epoch& epoch, PacketSink& out) override {
        for (const Observation& observation : epoch.observations) {
            const auto frame = std::holds_alternative<Range>(observation)
                                   ? encode(std::get<Range>(observation), settings_, 0, frames_)
                                   : encode(std::get<RangeDifference>(observation), settings_, 0, frames_);
            if (!frame) continue;
            ++frames_;
            out.packet(frame->packet(epoch.arrival));
        }
    }

  private:
    uwb::Dw1000CanSettings settings_;
    unsigned frames_ = 0;
};

struct Format {
    std::string_view decoder;
    std::string (*cannot_write)(const Scenario&, const Sensor&);
    std::unique_ptr<FrameWriter> (*make)(const Scenario&, const Sensor&);
};

std::unique_ptr<FrameWriter> make_trek(const Scenario& scenario, const Sensor& sensor) {
    return std::make_unique<TrekWriter>(scenario, decoder_settings<uwb::TrekSettings>(sensor));
}

std::unique_ptr<FrameWriter> make_can(const Scenario&, const Sensor& sensor) {
    return std::make_unique<CanWriter>(decoder_settings<uwb::Dw1000CanSettings>(sensor));
}

constexpr std::array formats{
    Format{"trek1000", cannot_write_trek, make_trek},
    Format{"dw1000_can", cannot_write_can, make_can},
};

const Format* find_format(std::string_view decoder) {
    const auto* const format = std::ranges::find(formats, decoder, &Format::decoder);
    return format == formats.end() ? nullptr : format;
}

} // namespace

std::string cannot_write(const Scenario& scenario, const Sensor& sensor) {
    const Format* const format = find_format(sensor.input.decoder->name);
    if (format != nullptr) return format->cannot_write(scenario, sensor);
    return "decoder " + std::string(sensor.input.decoder->name) + " cannot be simulated: use trek1000 or dw1000_can";
}

std::unique_ptr<FrameWriter> make_frame_writer(const Scenario& scenario, const Sensor& sensor) {
    return find_format(sensor.input.decoder->name)->make(scenario, sensor);
}

} // namespace locus::simulate
