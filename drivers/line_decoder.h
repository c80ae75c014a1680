// What decoders of text lines have in common: lines out of chunks, each with the time it began.
#pragma once

#include "drivers/decoder.h"
#include "drivers/line_splitter.h"

namespace locus {

class LineDecoder : public Decoder {
  public:
    void decode(const Packet& packet, MeasurementSink& sink) final {
        lines_.feed(
            packet,
            [&](std::string_view text, Timestamp complete) {
                const auto length = static_cast<std::int64_t>(text.size() + 2); // with its end
                line(text, complete - length * packet.byte_time, sink);
            },
            [&] { sink.refuse(Refusal::too_long); });
    }

    void reset() override { lines_.reset(); }

  protected:
    /// `text` is not empty. `begun`: when its first character began on the wire, where the wire's speed is known.
    virtual void line(std::string_view text, Timestamp begun, MeasurementSink& sink) = 0;

  private:
    LineSplitter lines_;
};

} // namespace locus
