// The seam between the V4L2 source and the kernel: the few system calls it makes, so that a test can play the device.
#pragma once

#include "fusion/time.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace locus::camera {

class V4l2Device {
  public:
    enum class Ready : std::uint8_t { nothing, frame, event, gone };

    virtual ~V4l2Device() = default;
    /// 0 or errno.
    virtual int open(const std::string& path) = 0;
    virtual void close() = 0;
    /// An ioctl, again when a signal broke it off: 0 or errno.
    virtual int control(unsigned long request, void* argument) = 0;
    /// One of the driver's buffers; empty: the kernel refused.
    virtual std::span<const std::uint8_t> map(std::size_t size, std::int64_t offset) = 0;
    virtual void unmap(std::span<const std::uint8_t> buffer) = 0;
    virtual Ready wait(Duration timeout) = 0;
};

/// The kernel's own.
std::unique_ptr<V4l2Device> make_v4l2_device();

} // namespace locus::camera
