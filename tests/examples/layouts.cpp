// Devices that are known by description only: the examples of protocols.md 2.2, 2.3 and 5.3 as layouts.
#include "drivers/layout/can_layout.h"
#include "drivers/layout/serial_layout.h"
#include "tests/examples/decoder_example.h"

#include <linux/can.h>

#include <cmath>

namespace locus::examples {

std::vector<DecoderExample> layouts();

namespace {

using namespace layout;

DecoderExample of(const SerialLayoutSettings& settings, const std::vector<std::vector<double>>& values) {
    DecoderExample example{"serial_layout"};
    for (int i = 0; i < 20; ++i) example.chunks.push_back(encode(settings, values));
    example.checksum = settings.checksum != "none";
    example.settings = std::make_shared<SerialLayoutSettings>(settings);
    return example;
}

/// Nooploop's nodeframe3 (2.2): length in the frame, count in the frame, sum at the end.
DecoderExample nlink_type() {
    SerialLayoutSettings nlink;
    nlink.sync = "55 05";
    nlink.length_bytes = 2;
    nlink.checksum = "sum8";
    nlink.elements_at_byte = 20;
    nlink.element_begin_byte = 21;
    nlink.element_bytes = 7;
    nlink.fields = {{.quantity = "tag", .at_byte = 5},
                    {.quantity = "anchor", .at_byte = 1, .in_element = true},
                    {.quantity = "range", .at_byte = 2, .bytes = 3, .in_element = true, .unit = "mm"},
                    {.quantity = "rx_power", .at_byte = 6, .in_element = true, .factor = -0.5, .unit = "dBm"}};
    // A sum of 8 bits misses one damage in 256; with these values none of the test.
    return of(nlink, {{3, 0, 2850, -79.5}, {3, 1, 6051, -80}});
}

/// Ai-Thinker's eight stations (2.3): fixed length, no checksum that is known, zero says "not seen".
DecoderExample bu03_type() {
    SerialLayoutSettings bu03;
    bu03.sync = "AA 25 01";
    bu03.frame_bytes = 35;
    bu03.elements = 8;
    bu03.element_begin_byte = 3;
    bu03.element_bytes = 4;
    bu03.tag = address(9);
    bu03.fields = {{.quantity = "range", .bytes = 4, .in_element = true, .unit = "mm", .invalid_raw = 0}};
    return of(bu03, {{1230}, {2340}, {0}, {3450}, {0}, {0}, {0}, {0}});
}

CanField wheel(std::uint32_t id, int start, int length, double factor, double offset, const char* order) {
    CanField field;
    field.quantity = "wheel_speed";
    field.can_id = id;
    field.start_bit = start;
    field.length_bits = length;
    field.byte_order = order;
    field.factor = factor;
    field.offset = offset;
    field.unit = "km/h";
    return field;
}

DecoderExample of(const CanLayoutSettings& settings, std::uint32_t id, const std::vector<double>& values) {
    DecoderExample example{"can_layout"};
    for (int i = 0; i < 20; ++i) example.frames.push_back(encode(settings, id, values));
    example.rubbish = {{id, 1, {}}};
    example.settings = std::make_shared<CanLayoutSettings>(settings);
    return example;
}

DecoderExample toyota() {
    CanLayoutSettings settings;
    settings.tag = address(1);
    for (const int start : {6, 22, 38, 54})
        settings.fields.push_back(wheel(0x0AA, start, 15, 0.01, -67.67, "motorola"));
    return of(settings, 0x0AA, {36.0, 36.5, 35.9, 36.1});
}

DecoderExample volkswagen() {
    CanLayoutSettings settings;
    settings.tag = address(1);
    for (const int start : {0, 16, 32, 48}) settings.fields.push_back(wheel(0x0B2, start, 16, 0.0075, 0, "intel"));
    return of(settings, 0x0B2, {36.0, 36.51, 35.9, 36.1});
}

} // namespace

std::vector<DecoderExample> layouts() { return {nlink_type(), bu03_type(), toyota(), volkswagen()}; }

} // namespace locus::examples
