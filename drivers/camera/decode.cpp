#include "drivers/camera/decode.h"

#include "drivers/camera/mat.h"

#include <opencv2/imgproc.hpp>
#include <turbojpeg.h>

#include <cstring>
#include <utility>

namespace locus::camera {
namespace {

bool is_possible_side(int side_px) { return side_px > 0 && side_px <= max_side_px; }

std::string size_text(int width_px, int height_px) {
    return std::to_string(width_px) + "x" + std::to_string(height_px);
}

int least_stride_bytes(const RawImage& raw) {
    return raw.format == PixelFormat::yuyv ? 2 * raw.width_px : raw.width_px;
}

std::size_t least_size_bytes(const RawImage& raw) {
    const auto plane = static_cast<std::size_t>(raw.stride_bytes) * static_cast<std::size_t>(raw.height_px);
    return raw.format == PixelFormat::nv12 ? plane + plane / 2 : plane;
}

/// A view of foreign bytes, which OpenCV takes as writable only; nobody writes through it.
cv::Mat view(const RawImage& raw, int rows, int columns, int type, std::size_t offset = 0) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    auto* bytes = const_cast<std::uint8_t*>(raw.bytes.data() + offset);
    return {rows, columns, type, bytes, static_cast<std::size_t>(raw.stride_bytes)};
}

void convert(const RawImage& raw, Picture& picture) {
    const int width = raw.width_px;
    const int height = raw.height_px;
    picture.resize(width, height, raw.format == PixelFormat::grey ? 1 : 3);
    cv::Mat to = as_mat(picture);
    if (raw.format == PixelFormat::grey) view(raw, height, width, CV_8UC1).copyTo(to);
    if (raw.format == PixelFormat::yuyv) cv::cvtColor(view(raw, height, width, CV_8UC2), to, cv::COLOR_YUV2BGR_YUYV);
    if (raw.format != PixelFormat::nv12) return;
    const auto luma_bytes = static_cast<std::size_t>(raw.stride_bytes) * static_cast<std::size_t>(height);
    cv::cvtColorTwoPlane(view(raw, height, width, CV_8UC1), view(raw, height / 2, width / 2, CV_8UC2, luma_bytes), to,
                         cv::COLOR_YUV2BGR_NV12);
}

} // namespace

class PictureDecoder::Jpeg {
  public:
    ~Jpeg() { tjDestroy(handle_); }

    /// Empty: done. A picture that ends early is refused whole: its lower half would be grey, which looks like motion.
    std::string decode(const RawImage& raw, Picture& picture) {
        int width = 0;
        int height = 0;
        int subsampling = 0;
        int colours = 0;
        const auto size = static_cast<unsigned long>(raw.bytes.size());
        if (tjDecompressHeader3(handle_, raw.bytes.data(), size, &width, &height, &subsampling, &colours) != 0)
            return "it is no JPEG: " + error();
        if (width != raw.width_px || height != raw.height_px)
            return "its JPEG is " + size_text(width, height) + " and not " + size_text(raw.width_px, raw.height_px);
        picture.resize(width, height, 3);
        const int result = tjDecompress2(handle_, raw.bytes.data(), size, picture.pixels.data(), width, 0, height,
                                         TJPF_BGR, TJFLAG_LIMITSCANS);
        return result == 0 || is_harmless() ? std::string{} : "its JPEG is damaged: " + error();
    }

  private:
    std::string error() const { return tjGetErrorStr2(handle_); }

    /// Many USB cameras pad before a marker; nothing of the picture is missing then.
    bool is_harmless() const {
        return tjGetErrorCode(handle_) == TJERR_WARNING && error().find("extraneous bytes") != std::string::npos;
    }

    tjhandle handle_ = tjInitDecompress();
};

PictureDecoder::PictureDecoder() : jpeg_{std::make_unique<Jpeg>()} {}
PictureDecoder::~PictureDecoder() = default;

bool PictureDecoder::decode(const RawImage& raw, Picture& picture) {
    if (!is_possible_side(raw.width_px) || !is_possible_side(raw.height_px))
        return refuse("a picture of " + size_text(raw.width_px, raw.height_px) + " is not possible");
    if (raw.format == PixelFormat::mjpeg) {
        error_ = jpeg_->decode(raw, picture);
        return error_.empty();
    }
    if (!fits(raw)) return false;
    convert(raw, picture);
    return true;
}

bool PictureDecoder::fits(const RawImage& raw) {
    const bool halves_columns = raw.format == PixelFormat::yuyv || raw.format == PixelFormat::nv12;
    const bool is_odd =
        (halves_columns && raw.width_px % 2 != 0) || (raw.format == PixelFormat::nv12 && raw.height_px % 2 != 0);
    if (is_odd) return refuse("a size of " + size_text(raw.width_px, raw.height_px) + " is odd, its colours are not");
    if (raw.stride_bytes < least_stride_bytes(raw) || raw.stride_bytes > 8 * max_side_px)
        return refuse("rows of " + std::to_string(raw.stride_bytes) + " bytes do not fit its width");
    if (raw.bytes.size() < least_size_bytes(raw))
        return refuse("only " + std::to_string(raw.bytes.size()) + " of " + std::to_string(least_size_bytes(raw)) +
                      " bytes came");
    return true;
}

bool PictureDecoder::refuse(std::string why) {
    error_ = std::move(why);
    return false;
}

} // namespace locus::camera
