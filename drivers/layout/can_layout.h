// CAN frames described in YAML, signal by signal, by the conventions of DBC files: wheel speeds, yaw rate, steering,
// pressure of a vehicle, ranges of a UWB device. Whoever has a DBC file copies its numbers; whoever has none finds them
// with `candump`. docs/describe-a-device.md shows how.
//
//   decoder: can_layout
//   tag: 1
//   fields:
//     - {quantity: wheel_speed, can_id: 0xB2, start_bit: 0, length_bits: 16, factor: 0.0075, unit: km/h}
#pragma once

#include "drivers/can_frame.h"
#include "drivers/layout/dbc_signal.h"
#include "drivers/layout/quantity.h"

#include <limits>
#include <string>
#include <vector>

namespace locus::layout {

struct CanField {
    std::string quantity;
    std::uint32_t can_id = 0;
    bool extended = false;
    std::uint32_t can_id_ignored = 0;
    int start_bit = 0;
    int length_bits = 8;
    std::string byte_order = "intel";
    std::string type = "unsigned";
    double factor = 1;
    double offset = 0;
    std::string unit = "none";
    int multiplexed_by = -1;
    double invalid_raw = std::numeric_limits<double>::quiet_NaN();

    BitField bits() const {
        return {static_cast<unsigned>(start_bit), static_cast<unsigned>(length_bits), byte_order == "motorola"};
    }
};

inline constexpr std::array can_field_options{
    option<&CanField::quantity>("quantity", "", -no_limit, no_limit, "What it means.", quantity_names, true),
    option<&CanField::can_id>("can_id", "", 0, 0x1FFFFFFF,
                              "Identifier of its frame; above 0x7FF it is an extended one.", {}, true),
    option<&CanField::extended>("extended", "Whether an identifier up to 0x7FF is an extended (29-bit) one."),
    option<&CanField::can_id_ignored>("can_id_ignored", "", 0, 0x1FFFFFFF,
                                      "Bits of the identifier that may be anything (J1939's source address: 0xFF)."),
    option<&CanField::start_bit>("start_bit", "", 0, 511,
                                 "As in a DBC file: the lowest bit (intel) or the highest (motorola).", {}, true),
    option<&CanField::length_bits>("length_bits", "", 1, 64, "Bits it has.", {}, true),
    option<&CanField::byte_order>("byte_order", "DBC's @1 is intel, @0 motorola.", byte_orders),
    option<&CanField::type>("type", "What the bits are.", value_types),
    option<&CanField::factor>("factor", "", -1e9, 1e9, "Worth of one step, in the unit."),
    option<&CanField::offset>("offset", "", -1e12, 1e12, "Value of zero steps, in the unit."),
    option<&CanField::unit>("unit", "Unit of factor and offset.", unit_names),
    option<&CanField::multiplexed_by>(
        "multiplexed_by", "", -1, 65535,
        "Value that the frame's multiplexor must have for this field to be there (DBC's mN); -1: always there."),
    option<&CanField::invalid_raw>("invalid_raw", "", 0, no_limit,
                                   "The bits that say \"not known\", as one unsigned number."),
};

struct CanLayoutSettings {
    Address tag = no_address;
    int anchor_offset = 0;
    int tag_offset = 0;
    std::vector<CanField> fields;
};

inline constexpr std::array can_layout_options{
    option<&CanLayoutSettings::tag>("tag", "Address of the target that carries it, where no field says so."),
    option<&CanLayoutSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                              "Added to the number of an anchor to make its address."),
    option<&CanLayoutSettings::tag_offset>("tag_offset", "", 0, 65535,
                                           "Added to the number of a tag to make its address."),
};
inline constexpr std::array can_layout_lists{
    option_list<&CanLayoutSettings::fields>("fields", "What the frames hold.", can_field_options)};

/// A sentence when fields do not fit together: unit and quantity, float and length, no field at all; else empty.
std::string check_can_layout(const void* settings);

/// One classic frame with the fields of one identifier: `values[i]` is settings.fields[i]'s in its own unit, NaN where
/// it is not there.
CanFrame encode(const CanLayoutSettings& settings, std::uint32_t can_id, std::span<const double> values);

std::unique_ptr<Decoder> make_can_layout(const void* settings);

} // namespace locus::layout
