#include "drivers/camera/v4l2_format.h"

#include "drivers/transport/stream.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>

namespace locus::camera {
namespace {

constexpr std::array<std::uint32_t, 4> fourccs{V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_NV12, V4L2_PIX_FMT_MJPEG,
                                               V4L2_PIX_FMT_GREY}; // in the order of PixelFormat
constexpr std::uint32_t most_listed = 32; // a driver that never says "that was all" must not hold us

std::string fourcc_text(std::uint32_t fourcc) {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) {
        const auto letter = static_cast<unsigned char>(fourcc >> shift);
        if (std::isgraph(letter)) text += static_cast<char>(letter);
    }
    return text;
}

std::string times(std::uint32_t width, std::uint32_t height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

std::string listed(const std::string& list) { return list.empty() ? "nothing it tells of" : list; }

std::string offered_formats(V4l2Device& device) {
    std::string list;
    for (std::uint32_t i = 0; i < most_listed; ++i) {
        v4l2_fmtdesc entry{};
        entry.index = i;
        entry.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        if (device.control(VIDIOC_ENUM_FMT, &entry) != 0) break;
        list += (list.empty() ? "" : ", ") + fourcc_text(entry.pixelformat);
    }
    return listed(list);
}

std::string offered_sizes(V4l2Device& device, std::uint32_t fourcc) {
    std::string list;
    for (std::uint32_t i = 0; i < most_listed; ++i) {
        v4l2_frmsizeenum entry{};
        entry.index = i;
        entry.pixel_format = fourcc;
        if (device.control(VIDIOC_ENUM_FRAMESIZES, &entry) != 0) break;
        if (entry.type != V4L2_FRMSIZE_TYPE_DISCRETE)
            return times(entry.stepwise.min_width, entry.stepwise.min_height) + " to " +
                   times(entry.stepwise.max_width, entry.stepwise.max_height);
        list += (list.empty() ? "" : ", ") + times(entry.discrete.width, entry.discrete.height);
    }
    return listed(list);
}

/// What the device makes of the wish; drivers answer with the nearest they can.
std::optional<v4l2_pix_format> ask(V4l2Device& device, const V4l2Settings& settings, std::uint32_t fourcc, int& error) {
    v4l2_format wish{};
    wish.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    wish.fmt.pix.width = static_cast<std::uint32_t>(settings.width_px);
    wish.fmt.pix.height = static_cast<std::uint32_t>(settings.height_px);
    wish.fmt.pix.pixelformat = fourcc;
    wish.fmt.pix.field = V4L2_FIELD_NONE;
    error = device.control(VIDIOC_S_FMT, &wish);
    return error == 0 ? std::optional{wish.fmt.pix} : std::nullopt;
}

/// Many devices (a grabber, a stream from elsewhere) have the rate that they have: what they answer counts.
double ask_rate_hz(V4l2Device& device, double wanted_hz) {
    v4l2_streamparm wish{};
    wish.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (wanted_hz > 0) {
        wish.parm.capture.timeperframe.numerator = 1000;
        wish.parm.capture.timeperframe.denominator = static_cast<std::uint32_t>(std::lround(1000 * wanted_hz));
    }
    if (device.control(wanted_hz > 0 ? VIDIOC_S_PARM : VIDIOC_G_PARM, &wish) != 0) return 0;
    const v4l2_fract interval = wish.parm.capture.timeperframe;
    return interval.numerator == 0 ? 0 : static_cast<double>(interval.denominator) / interval.numerator;
}

bool has_size(const v4l2_pix_format& given, const V4l2Settings& settings) {
    return given.width == static_cast<std::uint32_t>(settings.width_px) &&
           given.height == static_cast<std::uint32_t>(settings.height_px);
}

/// How well the device can do one format: whether it knows it at all, in this size, at this rate.
struct Answer {
    bool knows = false;
    bool is_busy = false;
    std::optional<StreamFormat> stream;
};

Answer try_format(V4l2Device& device, const V4l2Settings& settings, PixelFormat format) {
    const std::uint32_t fourcc = fourccs[static_cast<std::size_t>(format)];
    int error = 0;
    const auto given = ask(device, settings, fourcc, error);
    if (!given || given->pixelformat != fourcc) return {.is_busy = error == EBUSY, .stream = std::nullopt};
    if (!has_size(*given, settings)) return {.knows = true, .stream = std::nullopt};
    const auto stride = static_cast<int>(std::min<std::uint32_t>(given->bytesperline, 1u << 24));
    return {.knows = true,
            .stream = StreamFormat{.format = format,
                                   .width_px = settings.width_px,
                                   .height_px = settings.height_px,
                                   .stride_bytes = stride,
                                   .rate_hz = ask_rate_hz(device, settings.rate_hz)}};
}

bool is_fast_enough(const StreamFormat& stream, const V4l2Settings& settings) {
    return stream.rate_hz == 0 || stream.rate_hz > 0.99 * settings.rate_hz;
}

std::string refusal(V4l2Device& device, const V4l2Settings& settings, std::optional<PixelFormat> known) {
    const std::string camera = "'" + settings.path + "' does not give ";
    const std::string size = std::to_string(settings.width_px) + "x" + std::to_string(settings.height_px);
    if (!known)
        return camera + (settings.pixel_format == "any" ? "yuyv, nv12, mjpeg or grey" : settings.pixel_format) +
               " pictures; it offers " + offered_formats(device) + ": set pixel_format, or take another camera";
    return camera + size + " as " + std::string{name_of(*known)} + "; it offers " +
           offered_sizes(device, fourccs[static_cast<std::size_t>(*known)]) +
           ": set width_px and height_px to one of them";
}

} // namespace

std::optional<StreamFormat> negotiate(V4l2Device& device, const V4l2Settings& settings, std::string& error) {
    std::optional<PixelFormat> known;
    std::optional<StreamFormat> slow;
    for (const auto format : {PixelFormat::yuyv, PixelFormat::nv12, PixelFormat::mjpeg, PixelFormat::grey}) {
        if (settings.pixel_format != "any" && settings.pixel_format != name_of(format)) continue;
        const Answer answer = try_format(device, settings, format);
        if (answer.is_busy) {
            error = in_use_sentence(settings.path);
            return std::nullopt;
        }
        if (answer.knows && !known) known = format;
        if (!answer.stream) continue;
        if (is_fast_enough(*answer.stream, settings)) return answer.stream;
        if (!slow || answer.stream->rate_hz > slow->rate_hz) slow = answer.stream;
    }
    if (slow) return try_format(device, settings, slow->format).stream; // the last one asked for is what it is set to
    error = refusal(device, settings, known);
    return std::nullopt;
}

} // namespace locus::camera
