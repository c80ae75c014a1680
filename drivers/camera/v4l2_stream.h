// An open V4L2 device that streams: the format it agreed to and the buffers it shares (mmap). It knows nothing of what
// the pictures hold.
#pragma once

#include "drivers/camera/v4l2_device.h"
#include "drivers/camera/v4l2_format.h"
#include "drivers/camera/v4l2_settings.h"

#include <linux/videodev2.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace locus::camera {

class V4l2Stream {
  public:
    V4l2Stream(V4l2Settings settings, std::unique_ptr<V4l2Device> device)
        : settings_{std::move(settings)}, name_{"'" + settings_.path + "'"}, device_{std::move(device)} {}
    ~V4l2Stream() { close(); }
    V4l2Stream(const V4l2Stream&) = delete;
    V4l2Stream& operator=(const V4l2Stream&) = delete;

    /// False: error() says why and what to do.
    bool open();
    void close();
    V4l2Device::Ready wait(Duration timeout) { return device_->wait(timeout); }
    /// A filled buffer, which is the caller's until it is given back. Empty with error 0: none is filled.
    std::optional<v4l2_buffer> take(int& error);
    /// 0 or errno.
    int give_back(std::uint32_t index);

    /// The buffer's bytes, as many as there are at most, whatever the driver says.
    std::span<const std::uint8_t> bytes(const v4l2_buffer& buffer) const;
    const StreamFormat& format() const { return format_; }
    const V4l2Settings& settings() const { return settings_; }
    const std::string& name() const { return name_; } ///< the path in quotation marks
    const std::string& error() const { return error_; }

  private:
    bool is_camera();
    bool set_format();
    bool share_buffers();
    bool share(std::uint32_t index);
    bool start();
    bool refuse(std::string sentence);

    const V4l2Settings settings_;
    const std::string name_;
    std::unique_ptr<V4l2Device> device_;
    StreamFormat format_;
    std::vector<std::span<const std::uint8_t>> buffers_;
    bool streaming_ = false;
    std::string error_;
};

} // namespace locus::camera
