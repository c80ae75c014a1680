#include "drivers/vehicle/obd2.h"

namespace locus::vehicle {
namespace {

constexpr std::uint32_t all_units = 0x7DF, first_unit = 0x7E8, last_unit = 0x7EF;
constexpr std::uint8_t current_data = 0x01, positive_answer = 0x40, negative_answer = 0x7F;
constexpr unsigned questions_a_pressure = 10;

class Obd2 : public Decoder {
  public:
    explicit Obd2(const Obd2Settings& settings) : settings_{settings} {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        if (packet.can_id < first_unit || packet.can_id > last_unit) return;
        const auto data = packet.data;
        // ISO-TP single frame: its length, then mode, PID, value. Longer answers belong to other programs' questions.
        if (data.size() < 4 || data[0] > 7) return sink.refuse(Refusal::malformed);
        if (data[0] < 3 || data[1] == negative_answer || data[1] != (positive_answer | current_data))
            return sink.refuse(Refusal::unknown_type);
        sink.frame(packet.data);
        tell(static_cast<Pid>(data[2]), data[3], packet.time, sink);
    }

    std::optional<Packet> request(Timestamp now) override {
        if (settings_.listen_only || now < next_) return std::nullopt;
        next_ = now + duration_from_s(settings_.poll_period_s);
        question_ = obd2_request(++asked_ % questions_a_pressure == 0 ? Pid::barometric_pressure : Pid::speed);
        return question_.packet(now);
    }

  private:
    void tell(Pid pid, std::uint8_t value, Timestamp time, MeasurementSink& sink) const {
        if (pid == Pid::speed) {
            WheelSpeed speed;
            speed.tag = settings_.tag;
            speed.speed_mps = value / 3.6;
            sink.accept(time, speed);
        } else if (pid == Pid::barometric_pressure) {
            Pressure pressure;
            pressure.tag = settings_.tag;
            pressure.pressure_pa = value * 1000.0;
            sink.accept(time, pressure);
        }
    }

    Obd2Settings settings_;
    Timestamp next_{};
    unsigned asked_ = 0;
    CanFrame question_;
};

} // namespace

CanFrame obd2_request(Pid pid) { return {all_units, 8, {2, current_data, static_cast<std::uint8_t>(pid)}}; }

CanFrame obd2_answer(Pid pid, std::uint8_t value, std::uint32_t unit) {
    return {unit, 8, {3, positive_answer | current_data, static_cast<std::uint8_t>(pid), value}};
}

std::unique_ptr<Decoder> make_obd2(const void* settings) {
    return std::make_unique<Obd2>(*static_cast<const Obd2Settings*>(settings));
}

} // namespace locus::vehicle
