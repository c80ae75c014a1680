// What a camera's driver hands over, made a picture. It believes no size: neither the driver's nor the one inside a
// JPEG.
#pragma once

#include "drivers/camera/picture.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace locus::camera {

enum class PixelFormat : std::uint8_t { yuyv, nv12, mjpeg, grey };
inline constexpr std::array<std::string_view, 4> pixel_format_names{"yuyv", "nv12", "mjpeg", "grey"};

constexpr std::string_view name_of(PixelFormat format) { return pixel_format_names[static_cast<std::size_t>(format)]; }

struct RawImage {
    PixelFormat format = PixelFormat::yuyv;
    int width_px = 0;
    int height_px = 0;
    int stride_bytes = 0; ///< from row to row; not used by mjpeg
    std::span<const std::uint8_t> bytes;
};

class PictureDecoder {
  public:
    PictureDecoder();
    ~PictureDecoder();

    /// False: the picture is anything, and error() holds what is wrong, for a sentence. GREY gives one channel, all
    /// others three.
    bool decode(const RawImage& raw, Picture& picture);
    std::string_view error() const { return error_; }

  private:
    class Jpeg;
    bool fits(const RawImage& raw);
    bool refuse(std::string why);

    std::unique_ptr<Jpeg> jpeg_;
    std::string error_;
};

} // namespace locus::camera
