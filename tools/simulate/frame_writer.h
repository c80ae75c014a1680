// Measurements into the bytes or frames that a device would send, by the encoders that stand beside the decoders.
#pragma once

#include "drivers/transport/transport.h"
#include "tools/simulate/receiver.h"

#include <memory>
#include <string>

namespace locus::simulate {

class FrameWriter {
  public:
    virtual ~FrameWriter() = default;
    /// What cannot be said in this format is left out.
    virtual void write(const Epoch& epoch, PacketSink& out) = 0;
};

/// Why this sensor cannot be simulated in this scenario: a sentence, or empty. Asked before make_frame_writer().
std::string cannot_write(const Scenario& scenario, const Sensor& sensor);

std::unique_ptr<FrameWriter> make_frame_writer(const Scenario& scenario, const Sensor& sensor);

} // namespace locus::simulate
