// Frames of a binary format out of the chunks that a serial line gives. The format says what the bytes at the head may
// be; this keeps them until they are whole, throws single bytes away until a frame begins again, and dates what it
// finds. Damage costs only the frames that it hit: what a false head had claimed is looked through again.
#pragma once

#include "drivers/decoder.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace locus {

/// What a format says of the bytes at the head of a stream.
struct Look {
    enum class Kind : std::uint8_t { need, frame, none };
    Kind kind;
    std::size_t length = 0; ///< need: bytes without which it cannot say more; frame: how long it is
    Refusal reason = Refusal::garbage;

    static constexpr Look need(std::size_t length) { return {Kind::need, length, {}}; }
    static constexpr Look frame(std::size_t length) { return {Kind::frame, length, {}}; }
    static constexpr Look none(Refusal reason) { return {Kind::none, 0, reason}; }
};

/// One intact frame; the bytes are valid during the call only.
struct Frame {
    std::span<const std::uint8_t> bytes;
    Timestamp begun;    ///< when its first byte began on the wire, where the wire's speed is known; else as complete
    Timestamp complete; ///< when its last byte had come
};

/// `look` is given at least one byte. It never asks for more than max_length bytes, and is asked again when they are
/// there; what it refuses costs one byte.
template <class T>
concept FrameFormat = requires(const T& format, std::span<const std::uint8_t> bytes) {
    { format.look(bytes) } -> std::same_as<Look>;
    { T::max_length } -> std::convertible_to<std::size_t>;
};

template <FrameFormat Format>
class FrameStream {
  public:
    explicit FrameStream(Format format = {}) : format_{std::move(format)} {}

    /// Calls on_frame(const Frame&) for each intact frame that ends in the packet, and on_refuse(Refusal) for each
    /// damaged frame and once for each run of bytes that belong to none.
    template <class OnFrame, class OnRefuse>
    void feed(const Packet& packet, const OnFrame& on_frame, const OnRefuse& on_refuse) {
        if (size_ > 0 && packet.time - last_time_ > silence) drop_head(on_refuse);
        last_time_ = packet.time;
        for (auto rest = packet.data; !rest.empty();) {
            const auto taken = rest.first(std::min(rest.size(), buffer_.size() - size_));
            std::copy(taken.begin(), taken.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
            size_ += taken.size();
            rest = rest.subspan(taken.size());
            take_frames(packet.time - static_cast<std::int64_t>(rest.size()) * packet.byte_time, packet.byte_time,
                        on_frame, on_refuse);
        }
    }

    void reset() { size_ = 0, in_garbage_ = false; }

    /// Bytes of a frame that is not whole yet.
    std::span<const std::uint8_t> waiting() const { return {buffer_.data(), size_}; }

  private:
    /// A head that waits so long for its rest was none: no line sends half a frame and then pauses.
    static constexpr Duration silence = std::chrono::seconds{1};

    template <class OnFrame, class OnRefuse>
    void take_frames(Timestamp last_byte, Duration byte_time, const OnFrame& on_frame, const OnRefuse& on_refuse) {
        std::size_t at = 0;
        while (at < size_) {
            const std::span<const std::uint8_t> bytes{buffer_.data() + at, size_ - at};
            const Look look = format_.look(bytes);
            if (look.kind == Look::Kind::need && look.length > bytes.size() && look.length <= Format::max_length) break;
            if (look.kind != Look::Kind::frame || look.length == 0 || look.length > bytes.size()) {
                refuse(look.kind == Look::Kind::none ? look.reason : Refusal::malformed, on_refuse);
                ++at;
                continue;
            }
            in_garbage_ = false;
            at += look.length;
            const Timestamp complete = last_byte - static_cast<std::int64_t>(size_ - at) * byte_time;
            const auto length = static_cast<std::int64_t>(look.length);
            on_frame(Frame{bytes.first(look.length), complete - length * byte_time, complete});
        }
        discard(at);
    }

    template <class OnRefuse>
    void drop_head(const OnRefuse& on_refuse) {
        refuse(Refusal::malformed, on_refuse);
        discard(1);
    }

    template <class OnRefuse>
    void refuse(Refusal reason, const OnRefuse& on_refuse) {
        if (reason == Refusal::garbage && in_garbage_) return;
        in_garbage_ = reason == Refusal::garbage || in_garbage_;
        on_refuse(reason);
    }

    void discard(std::size_t count) {
        if (count == 0) return;
        std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(count),
                  buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
        size_ -= count;
    }

    Format format_;
    std::array<std::uint8_t, Format::max_length + 256> buffer_{};
    std::size_t size_ = 0;
    Timestamp last_time_{};
    bool in_garbage_ = false;
};

} // namespace locus
