// Where frames come from: a camera, a recorded video, a folder of images. The counterpart of transport.h for pictures:
// next() blocks for at most its timeout, a lost device is opened again by camera.h, for ever.
#pragma once

#include "drivers/camera/picture.h"

#include <cstdint>
#include <string_view>

namespace locus::camera {

enum class FrameStatus : std::uint8_t {
    frame,   ///< here is one
    nothing, ///< none within the timeout, or only damaged ones
    lost,    ///< the device is gone; last_error() says how
    ended,   ///< a recording was read to its end
};

class FrameSource {
  public:
    virtual ~FrameSource() = default;
    /// False: last_error() holds a sentence that says what is wrong and what to do.
    virtual bool open() = 0;
    virtual void close() = 0;
    /// The newest frame there is; older ones that nobody fetched count as dropped.
    virtual FrameStatus next(Frame& frame, Duration timeout) = 0;
    /// Frames that were taken and came to nobody, by their sequence numbers; counts on over re-opening.
    virtual std::uint64_t dropped() const { return 0; }
    /// Frames that came and could not be decoded; counts on over re-opening.
    virtual std::uint64_t damaged() const { return 0; }
    /// A trouble that does not stop it, in a sentence; empty when all is well.
    virtual std::string_view trouble() const { return {}; }
    virtual std::string_view last_error() const = 0;
};

} // namespace locus::camera
