// Raw recordings: each line goes to the decoder of the input it came from, as in drivers/input.h but without a device.
#include "drivers/recording/log_line.h"
#include "drivers/recording/measurement_json.h"
#include "tools/replay/recording.h"

namespace locus::replay {
namespace {

/// One input's decoder; gives its measurements the same marks as the live input does.
class RawInput final : public MeasurementSink {
  public:
    RawInput(const InputSettings& settings, std::uint16_t index, const Take& take, ReadReport& report)
        : decoder_(settings.decoder->make(settings.decoder_settings.get())), delay_(duration_from_s(settings.delay_s)),
          index_(index), wire_(settings.decoder->wire), take_(take), report_(report) {}

    void feed(const Packet& packet, std::string& error) {
        if (packet.wire != wire_) {
            error = wire_ == Wire::can ? "its input reads CAN, this line holds serial bytes"
                                       : "its input reads serial bytes, this line holds a CAN frame";
            return;
        }
        arrival_ = packet.time;
        decoder_->decode(packet, *this);
    }

    void accept(Timestamp time, const Observation& observation) override {
        take_({time - delay_, sequence_++, index_, observation}, arrival_);
    }
    void refuse(Refusal reason) override { ++report_.refused[static_cast<std::size_t>(reason)]; }

  private:
    std::unique_ptr<Decoder> decoder_;
    Duration delay_;
    std::uint16_t index_;
    Wire wire_;
    const Take& take_;
    ReadReport& report_;
    Timestamp arrival_{};
    std::uint32_t sequence_ = 0;
};

/// A camera's foot points, which its thread wrote down one a line.
class RawCamera {
  public:
    RawCamera(std::uint16_t index, const Take& take) : index_(index), take_(take) {}

    void feed(const Packet& packet, std::string& error) {
        std::string_view text(reinterpret_cast<const char*>(packet.data.data()), // NOLINT(*-reinterpret-cast): text
                              packet.data.size());
        if (text.ends_with('\n')) text.remove_suffix(1);
        auto measurement = from_json_line(text, error);
        if (!measurement.has_value()) return;
        measurement.value().input = index_;
        take_(measurement.value(), packet.time);
    }

  private:
    std::uint16_t index_;
    const Take& take_;
};

class RawReader final : public LineReader {
  public:
    RawReader(const Settings& settings, Take take, ReadReport& report) : take_(std::move(take)), report_(report) {
        for (std::size_t i = 0; i < settings.inputs.size(); ++i) {
            const InputSettings& input = settings.inputs[i];
            if (input.enabled) inputs_.try_emplace(input.name, input, static_cast<std::uint16_t>(i), take_, report_);
        }
        for (std::size_t i = 0; i < settings.cameras.size(); ++i)
            cameras_.try_emplace(settings.cameras[i].name, static_cast<std::uint16_t>(settings.inputs.size() + i),
                                 take_);
    }

    void read(std::string_view line, std::string& error) override {
        const auto record = from_log_line(line, error);
        if (!record) return;
        if (const auto camera = cameras_.find(record->input); camera != cameras_.end())
            return camera->second.feed(record->packet(), error);
        const auto input = inputs_.find(record->input);
        if (input == inputs_.end())
            ++report_.lines_of_unknown_inputs[record->input];
        else
            input->second.feed(record->packet(), error);
    }

  private:
    Take take_;
    ReadReport& report_;
    std::map<std::string, RawInput> inputs_;
    std::map<std::string, RawCamera> cameras_;
};

} // namespace

std::unique_ptr<LineReader> raw_reader(const Settings& settings, Take take, ReadReport& report) {
    return std::make_unique<RawReader>(settings, std::move(take), report);
}

} // namespace locus::replay
