// Measurements out of fields: see quantity.h.
#include "drivers/layout/quantity.h"

#include <cmath>

namespace locus::layout {
namespace {

// What no device of these kinds can mean: beyond it a field is read at the wrong place.
constexpr double farthest_m = 20e3;
constexpr double fastest_mps = 200;
constexpr double lowest_pa = 1e3, highest_pa = 200e3;

/// A field that names somebody: whole, and small enough for a double to hold exactly.
bool is_number(double value) { return value >= 0 && value < 9e15; }

} // namespace

Assembly::Assembly(std::vector<Quantity> quantities, const Owner& owner)
    : quantities_{std::move(quantities)}, values_(quantities_.size()), fresh_(quantities_.size()), owner_{owner} {}

void Assembly::set(std::size_t field, double value) {
    values_[field] = value;
    fresh_[field] = true;
}

void Assembly::reset() { fresh_.assign(fresh_.size(), false); }

void Assembly::emit(Timestamp time, std::uint64_t element, MeasurementSink& sink) {
    if (ready(Quantity::range)) emit_range(time, element, sink);
    if (ready(Quantity::rssi)) emit_rssi(time, element, sink);
    forget(Quantity::range, Quantity::rx_power);
    forget(Quantity::rssi, Quantity::multiplexor);
    if (ready(Quantity::wheel_speed)) emit_wheel_speed(time, sink);
    if (ready(Quantity::pressure)) emit_pressure(time, sink);
    for (auto q = Quantity::specific_force_x; q <= Quantity::angular_rate_z;
         q = static_cast<Quantity>(static_cast<int>(q) + 1))
        if (!ready(q)) return;
    emit_imu(time, sink);
}

/// There are such fields, and each of them has come.
bool Assembly::ready(Quantity quantity) const {
    bool any = false;
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
        if (quantities_[i] != quantity) continue;
        if (!fresh_[i]) return false;
        any = true;
    }
    return any;
}

double Assembly::mean(Quantity quantity) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < quantities_.size(); ++i)
        if (quantities_[i] == quantity && fresh_[i]) sum += values_[i], ++count;
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

void Assembly::forget(Quantity first, Quantity last) {
    for (std::size_t i = 0; i < quantities_.size(); ++i)
        if (quantities_[i] >= first && quantities_[i] <= last) fresh_[i] = false;
}

Address Assembly::anchor(std::uint64_t element) const {
    const double named = mean(Quantity::anchor);
    return address((is_number(named) ? static_cast<std::uint64_t>(named) : element) + owner_.anchor_offset);
}

Address Assembly::tag() const {
    const double named = mean(Quantity::tag);
    return is_number(named) ? address(static_cast<std::uint64_t>(named) + owner_.tag_offset) : owner_.tag;
}

void Assembly::emit_range(Timestamp time, std::uint64_t element, MeasurementSink& sink) {
    Range range;
    range.anchor = anchor(element);
    range.tag = tag();
    range.range_m = mean(Quantity::range);
    range.sigma_m = static_cast<float>(mean(Quantity::sigma));
    range.rx_power_dbm = static_cast<float>(mean(Quantity::rx_power));
    const bool possible = range.range_m >= 0 && range.range_m <= farthest_m && !(range.sigma_m <= 0);
    possible ? sink.accept(time, range) : sink.refuse(Refusal::out_of_range);
}

void Assembly::emit_rssi(Timestamp time, std::uint64_t element, MeasurementSink& sink) {
    SignalStrength strength;
    strength.transmitter = anchor(element);
    strength.receiver = tag();
    strength.rssi_dbm = static_cast<float>(mean(Quantity::rssi));
    const bool possible = std::abs(strength.rssi_dbm) < 200;
    possible ? sink.accept(time, strength) : sink.refuse(Refusal::out_of_range);
}

void Assembly::emit_wheel_speed(Timestamp time, MeasurementSink& sink) {
    WheelSpeed speed;
    speed.tag = tag();
    speed.speed_mps = mean(Quantity::wheel_speed);
    speed.yaw_rate_radps = static_cast<float>(mean(Quantity::yaw_rate));
    speed.steering_rad = static_cast<float>(mean(Quantity::steering));
    forget(Quantity::wheel_speed, Quantity::steering);
    const bool possible = std::abs(speed.speed_mps) <= fastest_mps;
    possible ? sink.accept(time, speed) : sink.refuse(Refusal::out_of_range);
}

void Assembly::emit_pressure(Timestamp time, MeasurementSink& sink) {
    Pressure pressure;
    pressure.tag = tag();
    pressure.pressure_pa = mean(Quantity::pressure);
    pressure.temperature_c = static_cast<float>(mean(Quantity::temperature));
    forget(Quantity::pressure, Quantity::temperature);
    const bool possible = pressure.pressure_pa >= lowest_pa && pressure.pressure_pa <= highest_pa;
    possible ? sink.accept(time, pressure) : sink.refuse(Refusal::out_of_range);
}

void Assembly::emit_imu(Timestamp time, MeasurementSink& sink) {
    ImuSample sample;
    sample.tag = tag();
    sample.specific_force_mps2 = {mean(Quantity::specific_force_x), mean(Quantity::specific_force_y),
                                  mean(Quantity::specific_force_z)};
    sample.angular_rate_radps = {mean(Quantity::angular_rate_x), mean(Quantity::angular_rate_y),
                                 mean(Quantity::angular_rate_z)};
    forget(Quantity::specific_force_x, Quantity::angular_rate_z);
    sink.accept(time, sample);
}

} // namespace locus::layout
