// Names, units and dimensions of the quantities of a described layout.
#include "drivers/layout/quantity.h"

#include "fusion/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace locus::layout {
namespace {

constexpr std::array<double, unit_names.size()> si{1,
                                                   1,
                                                   0.01,
                                                   0.001,
                                                   1,
                                                   1 / 3.6,
                                                   0.44704,
                                                   0.001,
                                                   1,
                                                   rad_per_deg,
                                                   1,
                                                   rad_per_deg,
                                                   1,
                                                   standard_gravity_mps2,
                                                   standard_gravity_mps2 * 1e-3,
                                                   1,
                                                   100,
                                                   1000,
                                                   1,
                                                   1,
                                                   1};

std::vector<std::string_view> units_of(Quantity quantity) {
    switch (quantity) {
    case Quantity::range:
    case Quantity::sigma:
        return {"m", "cm", "mm"};
    case Quantity::rx_power:
    case Quantity::rssi:
        return {"dBm", "dB"};
    case Quantity::wheel_speed:
        return {"m/s", "km/h", "mph", "mm/s"};
    case Quantity::yaw_rate:
    case Quantity::angular_rate_x:
    case Quantity::angular_rate_y:
    case Quantity::angular_rate_z:
        return {"rad/s", "deg/s"};
    case Quantity::steering:
        return {"rad", "deg"};
    case Quantity::pressure:
        return {"Pa", "hPa", "kPa"};
    case Quantity::temperature:
        return {"C"};
    case Quantity::specific_force_x:
    case Quantity::specific_force_y:
    case Quantity::specific_force_z:
        return {"m/s2", "g", "mg"};
    case Quantity::anchor:
    case Quantity::tag:
    case Quantity::multiplexor:
    case Quantity::count_:
        break;
    }
    return {"none"};
}

} // namespace

Quantity quantity_named(std::string_view name) {
    return static_cast<Quantity>(std::ranges::find(quantity_names, name) - quantity_names.begin());
}

double to_si(std::string_view unit) {
    return si.at(static_cast<std::size_t>(std::ranges::find(unit_names, unit) - unit_names.begin()));
}

std::string unit_complaint(Quantity quantity, std::string_view unit) {
    const auto units = units_of(quantity);
    if (std::ranges::find(units, unit) != units.end()) return "";
    return fmt::format("{} cannot have the unit {}; it can have {}", quantity_names[static_cast<std::size_t>(quantity)],
                       unit, fmt::join(units, ", "));
}

} // namespace locus::layout
