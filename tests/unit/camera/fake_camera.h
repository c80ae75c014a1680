// A camera as the kernel would show it, played by a test: what it offers, what it gives, and what goes wrong with it.
#pragma once

#include "drivers/camera/v4l2_device.h"

#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace locus::camera::test {

struct FakeFrame {
    std::uint32_t sequence = 0;
    std::vector<std::uint8_t> bytes;
    std::int64_t stamp_us = 5'000'000;
    std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_EOF;
};

struct FakeCameraState {
    struct Format {
        std::uint32_t fourcc, width, height;
        double rate_hz;
    };
    std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    std::vector<Format> formats{{V4L2_PIX_FMT_YUYV, 64, 48, 30}};
    std::map<unsigned long, int> fails; ///< errno by request
    int open_fails = 0;
    std::deque<FakeFrame> frames;
    bool event = false, gone = false;

    int opened = 0, mapped = 0;
    bool streaming = false;
    std::vector<std::vector<std::uint8_t>> memory = std::vector<std::vector<std::uint8_t>>(4);
    std::deque<std::uint32_t> queued;
    Format current{};
};

class FakeCamera : public V4l2Device {
  public:
    explicit FakeCamera(std::shared_ptr<FakeCameraState> state) : state_{std::move(state)} {}

    int open(const std::string&) override {
        if (state_->open_fails == 0) ++state_->opened;
        return state_->open_fails;
    }
    void close() override {
        state_->queued.clear();
        state_->streaming = false;
    }
    std::span<const std::uint8_t> map(std::size_t size, std::int64_t offset) override {
        ++state_->mapped;
        auto& memory = state_->memory[static_cast<std::size_t>(offset)];
        memory.resize(size);
        return memory;
    }
    void unmap(std::span<const std::uint8_t>) override { --state_->mapped; }
    Ready wait(Duration) override {
        if (state_->gone) return Ready::gone;
        if (state_->event) return Ready::event;
        return state_->frames.empty() ? Ready::nothing : Ready::frame;
    }

    int control(unsigned long request, void* argument) override {
        if (const auto failing = state_->fails.find(request); failing != state_->fails.end()) return failing->second;
        switch (request) {
        case VIDIOC_QUERYCAP:
            static_cast<v4l2_capability*>(argument)->capabilities = state_->capabilities;
            return 0;
        case VIDIOC_ENUM_FMT:
            return list_format(*static_cast<v4l2_fmtdesc*>(argument));
        case VIDIOC_ENUM_FRAMESIZES:
            return list_size(*static_cast<v4l2_frmsizeenum*>(argument));
        case VIDIOC_S_FMT:
            return set_format(static_cast<v4l2_format*>(argument)->fmt.pix);
        case VIDIOC_G_PARM:
        case VIDIOC_S_PARM:
            return tell_rate(*static_cast<v4l2_streamparm*>(argument));
        case VIDIOC_REQBUFS:
            static_cast<v4l2_requestbuffers*>(argument)->count = 4;
            return 0;
        case VIDIOC_QUERYBUF:
            return locate(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_QBUF:
            state_->queued.push_back(static_cast<v4l2_buffer*>(argument)->index);
            return 0;
        case VIDIOC_DQBUF:
            return fill(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_STREAMON:
            state_->streaming = true;
            return 0;
        case VIDIOC_STREAMOFF:
            state_->streaming = false;
            return 0;
        default:
            return ENOTTY;
        }
    }

  private:
    int list_format(v4l2_fmtdesc& entry) const {
        if (entry.index >= state_->formats.size()) return EINVAL;
        entry.pixelformat = state_->formats[entry.index].fourcc;
        return 0;
    }

    int list_size(v4l2_frmsizeenum& entry) const {
        std::uint32_t index = entry.index;
        for (const auto& format : state_->formats) {
            if (format.fourcc != entry.pixel_format || index-- != 0) continue;
            entry.type = V4L2_FRMSIZE_TYPE_DISCRETE;
            entry.discrete = {format.width, format.height};
            return 0;
        }
        return EINVAL;
    }

    /// Like a driver: an unknown format becomes the first, an unknown size the first of the format.
    int set_format(v4l2_pix_format& wish) {
        const FakeCameraState::Format* best = nullptr;
        for (const auto& format : state_->formats) {
            if (format.fourcc != wish.pixelformat) continue;
            const bool exact = format.width == wish.width && format.height == wish.height;
            if (!best || exact) best = &format;
        }
        state_->current = best ? *best : state_->formats.front();
        wish.pixelformat = state_->current.fourcc;
        wish.width = state_->current.width;
        wish.height = state_->current.height;
        wish.bytesperline = wish.width * (wish.pixelformat == V4L2_PIX_FMT_YUYV ? 2 : 1);
        return 0;
    }

    int tell_rate(v4l2_streamparm& rate) const {
        rate.parm.capture.timeperframe = {1000, static_cast<std::uint32_t>(1000 * state_->current.rate_hz)};
        return 0;
    }

    int locate(v4l2_buffer& buffer) const {
        buffer.length = 2 * state_->current.width * state_->current.height;
        buffer.m.offset = buffer.index;
        return 0;
    }

    int fill(v4l2_buffer& buffer) {
        if (state_->frames.empty() || state_->queued.empty()) return EAGAIN;
        const FakeFrame frame = state_->frames.front();
        state_->frames.pop_front();
        buffer.index = state_->queued.front();
        state_->queued.pop_front();
        auto& memory = state_->memory[buffer.index];
        const std::size_t size = std::min(memory.size(), frame.bytes.size());
        std::memcpy(memory.data(), frame.bytes.data(), size);
        buffer.bytesused = static_cast<std::uint32_t>(frame.bytes.size());
        buffer.sequence = frame.sequence;
        buffer.flags = frame.flags;
        buffer.timestamp = {frame.stamp_us / 1'000'000, frame.stamp_us % 1'000'000};
        return 0;
    }

    std::shared_ptr<FakeCameraState> state_;
};

} // namespace locus::camera::test
