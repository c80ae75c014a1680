// Frame by frame: what one decoder makes of the bytes as they come, and what it throws away.
#pragma once

#include "drivers/decoder.h"
#include "drivers/transport/transport.h"
#include "tools/sniff/tally.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace locus::sniff {

/// A frame that was understood, or a stretch that was not.
struct Entry {
    Timestamp time{};
    std::vector<std::uint8_t> bytes; ///< of the frame, or of the CAN frame that was refused; at most 2048 of them
    Wire wire = Wire::bytes;
    std::uint32_t can_id = 0;
    std::vector<Measurement> measurements;
    std::vector<Refusal> refusals; ///< not empty: nothing was understood
    std::size_t skipped = 0;       ///< bytes that belong to no frame
};

class Listing : public PacketSink, private MeasurementSink {
  public:
    using Tell = std::function<void(const Entry&)>;

    /// Of `most_frames` frames; 0: of all.
    Listing(const DecoderRow& decoder, const void* settings, std::uint64_t most_frames, Tell tell);

    void packet(const Packet& packet) override;
    /// Tells what was not told yet.
    void finish();

    /// What the device must be asked now.
    std::optional<Packet> request(Timestamp now) { return decoder_->request(now); }

    bool full() const { return most_frames_ > 0 && tally_.tally.frames >= most_frames_; }
    const Tally& tally() const { return tally_.tally; }
    std::uint64_t bytes() const { return bytes_; }
    std::uint64_t packets() const { return packets_; }
    Duration duration() const { return packets_ > 1 ? now_ - begun_ : Duration{}; }
    std::uint64_t skipped() const { return skipped_; }

  private:
    void feed(const Packet& packet);
    void accept(Timestamp time, const Observation& observation) override;
    void frame(std::span<const std::uint8_t> bytes) override;
    void refuse(Refusal reason) override;

    Entry entry(std::span<const std::uint8_t> bytes) const;
    void tell_frame();
    void tell_refusals(std::size_t understood);

    const DecoderRow& row_;
    std::unique_ptr<Decoder> decoder_;
    std::uint64_t most_frames_;
    Tell tell_;
    TallySink tally_;
    std::optional<Entry> frame_;
    std::vector<Refusal> refusals_; ///< since the last frame
    Packet current_{};
    Timestamp begun_{}, now_{};
    std::uint64_t packets_ = 0, bytes_ = 0, accounted_ = 0, skipped_ = 0;
};

} // namespace locus::sniff
