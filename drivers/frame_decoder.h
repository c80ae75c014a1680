// What decoders of binary formats have in common: intact frames out of chunks, and the refusals of all that is none.
#pragma once

#include "drivers/decoder.h"
#include "drivers/wire/frame_stream.h"

#include <utility>

namespace locus {

template <FrameFormat Format>
class FrameDecoder : public Decoder {
  public:
    explicit FrameDecoder(Format format = {}) : frames_{std::move(format)} {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        frames_.feed(
            packet, [&](const Frame& whole) { frame(whole, sink); }, [&](Refusal reason) { sink.refuse(reason); });
    }

    void reset() override { frames_.reset(); }

  protected:
    virtual void frame(const Frame& frame, MeasurementSink& sink) = 0;

    /// Bytes of a frame that is not whole yet.
    std::span<const std::uint8_t> waiting() const { return frames_.waiting(); }

  private:
    FrameStream<Format> frames_;
};

} // namespace locus
