// Frames of a serial line described in YAML: sync bytes, length rule, fields, checksum. For devices that this house
// does not know, and for those that nobody has published (UM100). docs/describe-a-device.md shows how to come from a
// hex dump to a description; config/examples/ has some.
#pragma once

#include "drivers/layout/dbc_signal.h"
#include "drivers/layout/quantity.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace locus::layout {

struct SerialField {
    std::string quantity;
    int at_byte = 0;
    int bytes = 1;
    bool in_element = false;
    std::string byte_order = "little";
    std::string type = "unsigned";
    double factor = 1;
    double offset = 0;
    std::string unit = "none";
    double invalid_raw = std::numeric_limits<double>::quiet_NaN();
};

struct SerialLayoutSettings {
    std::string sync;
    int frame_bytes = 0;
    int length_at_byte = 2;
    int length_bytes = 1;
    int length_adds = 0;
    std::string length_byte_order = "little";
    std::string checksum = "none";
    int checksum_from_byte = 0;
    int checksum_trailer_bytes = 0;
    std::string checksum_byte_order = "little";
    std::string tail;
    int elements = 0;
    int elements_at_byte = 0;
    int element_begin_byte = 0;
    int element_bytes = 0;
    Address tag = no_address;
    int anchor_offset = 0;
    int tag_offset = 0;
    std::vector<SerialField> fields;
};

inline constexpr std::size_t longest_serial_frame = 2048;

inline constexpr std::array<std::string_view, 2> serial_byte_orders{"little", "big"};
inline constexpr std::array<std::string_view, 8> checksum_names{
    "none", "sum8", "sum8_complement", "xor8", "fletcher8", "crc16_xmodem", "crc16_kermit", "crc16_modbus"};

inline constexpr std::array serial_field_options{
    option<&SerialField::quantity>("quantity", "", -no_limit, no_limit, "What it means.", quantity_names, true),
    option<&SerialField::at_byte>("at_byte", "", 0, 2047,
                                  "Its first byte, counted from 0 at the frame's (or element's) begin.", {}, true),
    option<&SerialField::bytes>("bytes", "", 1, 8, "Bytes it has.", {}, true),
    option<&SerialField::in_element>("in_element", "Whether it stands in every element and not once in the frame."),
    option<&SerialField::byte_order>("byte_order", "Which byte comes first.", serial_byte_orders),
    option<&SerialField::type>("type", "What the bytes are.", value_types),
    option<&SerialField::factor>("factor", "", -1e9, 1e9, "Worth of one step, in the unit."),
    option<&SerialField::offset>("offset", "", -1e12, 1e12, "Value of zero steps, in the unit."),
    option<&SerialField::unit>("unit", "Unit of factor and offset.", unit_names),
    option<&SerialField::invalid_raw>("invalid_raw", "", 0, no_limit,
                                      "The bytes that say \"not known\", as one unsigned number."),
};

using SerialSettings = SerialLayoutSettings; // for short rows

inline constexpr std::array serial_layout_options{
    required_option<&SerialSettings::sync>("sync", "Bytes that every frame begins with, in hex: \"AA 25 01\"."),
    option<&SerialSettings::frame_bytes>("frame_bytes", "", 0, 2048,
                                         "Length of a frame, all in all; 0: it says so itself."),
    option<&SerialSettings::length_at_byte>("length_at_byte", "", 0, 2047, "Where the frame says its length."),
    option<&SerialSettings::length_bytes>("length_bytes", "", 1, 4, "Bytes of that length."),
    option<&SerialSettings::length_adds>("length_adds", "", -64, 64,
                                         "What is added to that length to make the whole frame's."),
    option<&SerialSettings::length_byte_order>("length_byte_order", "Which byte of it comes first.",
                                               serial_byte_orders),
    option<&SerialSettings::checksum>("checksum", "How the end of the frame guards it.", checksum_names),
    option<&SerialSettings::checksum_from_byte>("checksum_from_byte", "", 0, 2047, "First byte that it covers."),
    option<&SerialSettings::checksum_trailer_bytes>("checksum_trailer_bytes", "", 0, 16, "Bytes that come after it."),
    option<&SerialSettings::checksum_byte_order>("checksum_byte_order", "Which byte of it comes first.",
                                                 serial_byte_orders),
    option<&SerialSettings::tail>("tail", "Bytes that every frame ends with, in hex; empty: none."),
    option<&SerialSettings::elements>("elements", "", 0, 256, "Elements that repeat; 0: the frame says how many."),
    option<&SerialSettings::elements_at_byte>("elements_at_byte", "", 0, 2047, "The byte with the number of elements."),
    option<&SerialSettings::element_begin_byte>("element_begin_byte", "", 0, 2047, "Where the first element begins."),
    option<&SerialSettings::element_bytes>("element_bytes", "", 0, 255, "Length of an element; 0: nothing repeats."),
    option<&SerialSettings::tag>("tag", "Address of the target that carries it, where no field says so."),
    option<&SerialSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                           "Added to the number of an anchor (or of an element) to make its address."),
    option<&SerialSettings::tag_offset>("tag_offset", "", 0, 65535,
                                        "Added to the number of a tag to make its address."),
};
inline constexpr std::array serial_layout_lists{
    option_list<&SerialSettings::fields>("fields", "What the frame holds.", serial_field_options)};

/// A sentence when the settings do not fit together; empty when they do.
std::string check_serial_layout(const void* settings);

/// A frame whose field i of element k is values[k][i] in its own unit (fields outside elements: of values[0]); the rest
/// is zero, length and checksum are right. With frame_bytes 0 it is as long as its elements need.
std::vector<std::uint8_t> encode(const SerialLayoutSettings& settings, std::span<const std::vector<double>> values);

std::unique_ptr<Decoder> make_serial_layout(const void* settings);

} // namespace locus::layout
