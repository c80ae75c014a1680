#include "drivers/camera/v4l2_source.h"

#include "drivers/camera/decode.h"
#include "drivers/camera/v4l2_buffer.h"
#include "drivers/camera/v4l2_stream.h"
#include "drivers/clock.h"

#include <cmath>
#include <cstring>
#include <utility>

namespace locus::camera {
namespace {

/// One damaged frame is a spark on the cable, a row of them is a trouble, a longer row may be mended by asking anew.
constexpr int troubling_run = 5;
constexpr int losing_run = 30;
constexpr int most_buffers = 8;

class V4l2Source : public FrameSource {
  public:
    V4l2Source(const V4l2Settings& settings, std::unique_ptr<V4l2Device> device)
        : stream_{settings, std::move(device)} {}

    bool open() override {
        trouble_.clear();
        damaged_in_a_row_ = 0;
        counter_.restart();
        if (!stream_.open()) {
            error_ = stream_.error();
            return false;
        }
        heard_ = monotonic_now();
        note_rate();
        return true;
    }

    void close() override { stream_.close(); }

    FrameStatus next(Frame& frame, Duration timeout) override {
        switch (stream_.wait(timeout)) {
        case V4l2Device::Ready::frame:
            return take_newest(frame);
        case V4l2Device::Ready::event:
            return lost("its signal changed: it is asked again what it gives");
        case V4l2Device::Ready::gone:
            return lost("unplugged, or its driver gave up");
        case V4l2Device::Ready::nothing:
            break;
        }
        const double silence_s = stream_.settings().silence_s;
        if (monotonic_now() - heard_ < duration_from_s(silence_s)) return FrameStatus::nothing;
        return lost("it gave no frame for " + std::to_string(std::lround(1000 * silence_s)) + " ms");
    }

    std::uint64_t dropped() const override { return dropped_; }
    std::uint64_t damaged() const override { return damaged_; }
    std::string_view trouble() const override { return trouble_; }
    std::string_view last_error() const override { return error_; }

  private:
    void note_rate() {
        const double rate_hz = stream_.format().rate_hz;
        if (rate_hz == 0 || rate_hz > 0.99 * stream_.settings().rate_hz) return;
        trouble_ = stream_.name() + " gives only " + std::to_string(std::lround(rate_hz)) +
                   " frames a second at this size; a smaller one or another pixel_format may be faster";
    }

    /// A detector that is slower than the camera shall look at now, not at what waited in the driver.
    FrameStatus take_newest(Frame& frame) {
        std::optional<v4l2_buffer> newest;
        int error = 0;
        for (int i = 0; i < most_buffers; ++i) {
            const auto buffer = stream_.take(error);
            if (!buffer) break;
            dropped_ += counter_.take(buffer->sequence) + (newest ? 1 : 0);
            if (newest) error = stream_.give_back(newest->index);
            newest = buffer;
            if (error != 0) break;
        }
        if (error != 0) return lost(std::strerror(error));
        return newest ? hand_over(*newest, frame) : FrameStatus::nothing;
    }

    FrameStatus hand_over(const v4l2_buffer& buffer, Frame& frame) {
        heard_ = monotonic_now();
        frame.captured = stamp(buffer);
        frame.sequence = counter_.count();
        const bool good = decode(buffer, frame.picture);
        if (const int error = stream_.give_back(buffer.index)) return lost(std::strerror(error));
        return good ? whole_frame() : damaged_frame();
    }

    Timestamp stamp(const v4l2_buffer& buffer) {
        const V4l2Settings& settings = stream_.settings();
        if (const auto time = capture_time(buffer, settings)) return *time;
        trouble_ = stream_.name() + " stamps its frames by no clock that we know: they get the time of their arrival";
        return heard_ - duration_from_s(0.5 * settings.exposure_s + settings.delay_s);
    }

    bool decode(const v4l2_buffer& buffer, Picture& picture) {
        if (buffer.flags & V4L2_BUF_FLAG_ERROR) return false;
        const StreamFormat& format = stream_.format();
        const RawImage raw{.format = format.format,
                           .width_px = format.width_px,
                           .height_px = format.height_px,
                           .stride_bytes = format.stride_bytes,
                           .bytes = stream_.bytes(buffer)};
        return decoder_.decode(raw, picture);
    }

    FrameStatus whole_frame() {
        if (std::exchange(damaged_in_a_row_, 0) >= troubling_run) trouble_.clear();
        return FrameStatus::frame;
    }

    FrameStatus damaged_frame() {
        ++damaged_;
        ++damaged_in_a_row_;
        const std::string why = "gives damaged frames (cable, USB hub): " + std::string{decoder_.error()};
        if (damaged_in_a_row_ >= losing_run) return lost("it " + why);
        if (damaged_in_a_row_ >= troubling_run) trouble_ = stream_.name() + " " + why;
        return FrameStatus::nothing;
    }

    FrameStatus lost(const std::string& how) {
        error_ = stream_.name() + " is lost: " + how;
        return FrameStatus::lost;
    }

    V4l2Stream stream_;
    PictureDecoder decoder_;
    FrameCounter counter_;
    Timestamp heard_; ///< when the last frame came, or the stream began
    std::uint64_t dropped_ = 0;
    std::uint64_t damaged_ = 0;
    int damaged_in_a_row_ = 0;
    std::string trouble_;
    std::string error_;
};

} // namespace

std::unique_ptr<FrameSource> make_v4l2_source(const V4l2Settings& settings, std::unique_ptr<V4l2Device> device) {
    return std::make_unique<V4l2Source>(settings, std::move(device));
}

} // namespace locus::camera
