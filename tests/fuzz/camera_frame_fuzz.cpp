// What a camera may hand over: the first bytes say what the driver claims (format, size, rows), the rest is the frame.
// A picture that comes out has the size that was claimed, whatever a JPEG says of itself.
#include "drivers/camera/decode.h"

#include <cstdlib>

using namespace locus::camera;

namespace {

constexpr std::size_t header_size = 4;

RawImage claimed(const std::uint8_t* data, std::size_t size) {
    RawImage raw{.format = static_cast<PixelFormat>(data[0] % 4),
                 .width_px = data[1] - 8, // some are not possible
                 .height_px = data[2],
                 .stride_bytes = 4 * data[3],
                 .bytes = {data + header_size, size - header_size}};
    if (data[0] & 0x80) raw.width_px *= 1000;
    return raw;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < header_size) return 0;
    static PictureDecoder decoder;
    Picture picture;
    const RawImage raw = claimed(data, size);
    if (!decoder.decode(raw, picture)) {
        if (decoder.error().empty()) std::abort();
        return 0;
    }
    const auto expected = static_cast<std::size_t>(raw.width_px) * static_cast<std::size_t>(raw.height_px) *
                          static_cast<std::size_t>(picture.channels);
    if (picture.width_px != raw.width_px || picture.height_px != raw.height_px || picture.pixels.size() != expected)
        std::abort();
    return 0;
}
