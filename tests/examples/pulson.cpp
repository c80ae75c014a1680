#include "drivers/uwb/pulson/envelope.h"
#include "drivers/uwb/pulson/messages.h"
#include "drivers/uwb/pulson/pulson_can.h"
#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> pulson() {
    using namespace uwb::pulson;
    DecoderExample usb{"pulson_usb"}, uart{"pulson_uart"}, udp{"pulson_udp"}, can{"pulson_can"};
    for (std::uint16_t i = 0; i < 20; ++i) {
        FullRange range{.message = i, .responder = 100u + i, .precise_mm = 5234u + i, .precise_sigma_mm = 21};
        range.parts = precise;
        const SmallRange small{.message = i, .responder = 7, .range_cm = 523, .sigma_cm = 2, .parts = precise};
        const auto message = i % 2 ? encode(range) : encode(small);
        usb.chunks.push_back(UsbFormat::wrap(message));
        uart.chunks.push_back(UartFormat::wrap(message));
        udp.chunks.push_back(message);
        for (const CanFrame& frame : can_frames(message)) can.frames.push_back(frame);
    }
    usb.checksum = false;
    udp.datagrams = true;
    can.rubbish = {can.frames[2], can.frames[0], can.frames[2]};
    return {usb, uart, udp, can};
}

} // namespace locus::examples
