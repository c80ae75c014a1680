// What a field of a described layout can mean, in which units it may be given, and how whole measurements are put
// together from such fields. This is what lets a device be described in YAML instead of written in C++.
#pragma once

#include "drivers/decoder.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace locus::layout {

enum class Quantity : std::uint8_t {
    range,
    anchor,
    tag,
    sigma,
    rx_power,
    wheel_speed,
    yaw_rate,
    steering,
    pressure,
    temperature,
    specific_force_x,
    specific_force_y,
    specific_force_z,
    angular_rate_x,
    angular_rate_y,
    angular_rate_z,
    rssi,
    multiplexor,
    count_
};

inline constexpr std::size_t quantity_count = static_cast<std::size_t>(Quantity::count_);
inline constexpr std::array<std::string_view, quantity_count> quantity_names{"range",
                                                                             "anchor",
                                                                             "tag",
                                                                             "sigma",
                                                                             "rx_power",
                                                                             "wheel_speed",
                                                                             "yaw_rate",
                                                                             "steering",
                                                                             "pressure",
                                                                             "temperature",
                                                                             "specific_force_x",
                                                                             "specific_force_y",
                                                                             "specific_force_z",
                                                                             "angular_rate_x",
                                                                             "angular_rate_y",
                                                                             "angular_rate_z",
                                                                             "rssi",
                                                                             "multiplexor"};

/// `name` is one of quantity_names.
Quantity quantity_named(std::string_view name);

inline constexpr std::array<std::string_view, 21> unit_names{"none", "m",   "cm",  "mm",    "m/s",   "km/h", "mph",
                                                             "mm/s", "rad", "deg", "rad/s", "deg/s", "m/s2", "g",
                                                             "mg",   "Pa",  "hPa", "kPa",   "C",     "dBm",  "dB"};

/// Factor to SI units (degrees Celsius, dBm). `unit` is one of unit_names.
double to_si(std::string_view unit);

/// "yaw_rate cannot be in km/h: rad/s or deg/s"; empty when the unit fits.
std::string unit_complaint(Quantity quantity, std::string_view unit);

/// Whose measurements they are where no field says so.
struct Owner {
    Address tag = no_address;
    std::uint64_t anchor_offset = 0; ///< added to a field's anchor, and to an element's index where no field names one
    std::uint64_t tag_offset = 0;
};

/// What a layout's settings say of it.
template <class Settings>
Owner owner_of(const Settings& settings) {
    return {settings.tag, static_cast<std::uint64_t>(settings.anchor_offset),
            static_cast<std::uint64_t>(settings.tag_offset)};
}

/// Of each field of a layout.
template <class Field>
std::vector<Quantity> quantities_of(const std::vector<Field>& fields) {
    std::vector<Quantity> quantities;
    for (const Field& field : fields) quantities.push_back(quantity_named(field.quantity));
    return quantities;
}

/// Puts measurements together from fields that may come in several frames. A measurement goes out when every field that
/// it needs has come since the last one; several fields of one quantity (four wheels) are averaged.
class Assembly {
  public:
    Assembly(std::vector<Quantity> quantities, const Owner& owner);

    void set(std::size_t field, double value);
    /// After each frame or element. Ranges and signal strengths are of that frame alone.
    void emit(Timestamp time, std::uint64_t element, MeasurementSink& sink);
    void reset();

  private:
    bool ready(Quantity quantity) const;
    double mean(Quantity quantity) const;
    void forget(Quantity first, Quantity last);
    void emit_range(Timestamp time, std::uint64_t element, MeasurementSink& sink);
    void emit_rssi(Timestamp time, std::uint64_t element, MeasurementSink& sink);
    void emit_wheel_speed(Timestamp time, MeasurementSink& sink);
    void emit_imu(Timestamp time, MeasurementSink& sink);
    void emit_pressure(Timestamp time, MeasurementSink& sink);
    Address anchor(std::uint64_t element) const;
    Address tag() const;

    std::vector<Quantity> quantities_; ///< of each field
    std::vector<double> values_;
    std::vector<bool> fresh_;
    Owner owner_;
};

} // namespace locus::layout
