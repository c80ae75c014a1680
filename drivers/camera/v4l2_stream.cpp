#include "drivers/camera/v4l2_stream.h"

#include "drivers/transport/stream.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace locus::camera {
namespace {

constexpr std::uint32_t wanted_buffers = 4; // one is filled, one is decoded, two for a thread that comes late

std::string camera_open_sentence(const std::string& path, int reason) {
    const std::string device = "'" + path + "'";
    switch (reason) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return device + " is not there: is the camera plugged in? `ls /dev/v4l/by-id` shows what is";
    case EACCES:
    case EPERM:
        return "no permission for " + device + ": add this user to the group that `ls -lL` shows (video)";
    default:
        return device + " cannot be opened: " + std::strerror(reason);
    }
}

std::string start_sentence(const std::string& path, const std::string& what, int reason) {
    if (reason == EBUSY) return in_use_sentence(path);
    const std::string name = "'" + path + "'";
    if (reason == ENOSPC)
        return name + " finds no room on its USB bus beside other devices: use another port, pixel_format: mjpeg or a "
                      "smaller size";
    return name + " " + what + ": " + std::strerror(reason);
}

v4l2_buffer capture_buffer(std::uint32_t index = 0) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    return buffer;
}

} // namespace

bool V4l2Stream::open() {
    close();
    if (const int failed = device_->open(settings_.path)) return refuse(camera_open_sentence(settings_.path, failed));
    if (is_camera() && set_format() && share_buffers() && start()) return true;
    close();
    return false;
}

void V4l2Stream::close() {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (std::exchange(streaming_, false)) device_->control(VIDIOC_STREAMOFF, &type);
    for (const auto& buffer : buffers_) device_->unmap(buffer);
    buffers_.clear();
    device_->close();
}

std::optional<v4l2_buffer> V4l2Stream::take(int& error) {
    v4l2_buffer buffer = capture_buffer();
    error = device_->control(VIDIOC_DQBUF, &buffer);
    if (error == 0 && buffer.index >= buffers_.size()) error = EPROTO; // a buffer that there is not
    if (error == 0) return buffer;
    if (error == EAGAIN) error = 0;
    return std::nullopt;
}

int V4l2Stream::give_back(std::uint32_t index) {
    v4l2_buffer buffer = capture_buffer(index);
    return device_->control(VIDIOC_QBUF, &buffer);
}

std::span<const std::uint8_t> V4l2Stream::bytes(const v4l2_buffer& buffer) const {
    const auto memory = buffers_[buffer.index];
    return memory.first(std::min<std::size_t>(buffer.bytesused, memory.size()));
}

bool V4l2Stream::is_camera() {
    v4l2_capability capability{};
    if (device_->control(VIDIOC_QUERYCAP, &capability) != 0)
        return refuse(name_ + " is no camera: `v4l2-ctl --list-devices` shows those that are");
    const bool tells_of_node = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
    const std::uint32_t can = tells_of_node ? capability.device_caps : capability.capabilities;
    if (can & V4L2_CAP_VIDEO_CAPTURE_MPLANE)
        return refuse(name_ + " gives pictures in several planes, which locusd cannot take: use a USB camera");
    if (!(can & V4L2_CAP_VIDEO_CAPTURE))
        return refuse(name_ + " gives no pictures (an output, or a camera's node for other data): "
                              "`v4l2-ctl --list-devices` shows its other nodes");
    return (can & V4L2_CAP_STREAMING) != 0 || refuse(name_ + " cannot share its buffers (no streaming)");
}

/// Cameras without a cable in front know no change of signal and refuse the subscription; that is no error.
bool V4l2Stream::set_format() {
    v4l2_event_subscription changes{};
    changes.type = V4L2_EVENT_SOURCE_CHANGE;
    device_->control(VIDIOC_SUBSCRIBE_EVENT, &changes);
    std::string why;
    const auto format = negotiate(*device_, settings_, why);
    if (!format) return refuse(std::move(why));
    format_ = *format;
    return true;
}

bool V4l2Stream::share_buffers() {
    v4l2_requestbuffers request{};
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    request.count = wanted_buffers;
    if (const int failed = device_->control(VIDIOC_REQBUFS, &request))
        return refuse(start_sentence(settings_.path, "gives no buffers", failed));
    for (std::uint32_t i = 0; i < std::min(request.count, 2 * wanted_buffers); ++i)
        if (!share(i)) return false;
    return !buffers_.empty() || refuse(name_ + " gives no buffers: has the machine memory left?");
}

bool V4l2Stream::share(std::uint32_t index) {
    v4l2_buffer buffer = capture_buffer(index);
    if (const int failed = device_->control(VIDIOC_QUERYBUF, &buffer))
        return refuse(start_sentence(settings_.path, "does not tell where its buffers are", failed));
    const auto memory = device_->map(buffer.length, buffer.m.offset);
    if (memory.empty()) return refuse(name_ + " does not share its buffers: has the machine memory left?");
    buffers_.push_back(memory);
    return true;
}

bool V4l2Stream::start() {
    for (std::uint32_t i = 0; i < buffers_.size(); ++i)
        if (const int failed = give_back(i))
            return refuse(start_sentence(settings_.path, "does not take its buffers back", failed));
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (const int failed = device_->control(VIDIOC_STREAMON, &type))
        return refuse(start_sentence(settings_.path, "does not start", failed));
    streaming_ = true;
    return true;
}

bool V4l2Stream::refuse(std::string sentence) {
    error_ = std::move(sentence);
    return false;
}

} // namespace locus::camera
