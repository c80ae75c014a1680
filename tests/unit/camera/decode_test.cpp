#include "drivers/camera/decode.h"

#include <opencv2/imgcodecs.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace locus::camera {
namespace {

using testing::HasSubstr;

/// Left half red, right half white.
cv::Mat red_and_white(int width, int height) {
    cv::Mat picture(height, width, CV_8UC3, cv::Scalar(255, 255, 255));
    picture.colRange(0, width / 2).setTo(cv::Scalar(0, 0, 255));
    return picture;
}

std::vector<std::uint8_t> jpeg(const cv::Mat& picture) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
    return bytes;
}

void expect_colour(const Picture& picture, int x, int y, std::array<int, 3> bgr) {
    const std::size_t at = static_cast<std::size_t>(y * picture.width_px + x) * 3;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(picture.pixels[at + i], bgr[i], 6) << "channel " << i;
}

TEST(Decode, JpegIsWhatWasMade) {
    const auto bytes = jpeg(red_and_white(64, 32));
    PictureDecoder decoder;
    Picture picture;
    ASSERT_TRUE(
        decoder.decode({.format = PixelFormat::mjpeg, .width_px = 64, .height_px = 32, .bytes = bytes}, picture));
    expect_colour(picture, 8, 16, {0, 0, 255});
    expect_colour(picture, 56, 16, {255, 255, 255});
}

TEST(Decode, JpegThatEndsEarlyIsRefusedWherever) {
    auto bytes = jpeg(red_and_white(64, 64));
    PictureDecoder decoder;
    Picture picture;
    for (std::size_t size = 0; size + 2 < bytes.size(); ++size) // the two are the end's mark, which nothing needs
        ASSERT_FALSE(decoder.decode(
            {.format = PixelFormat::mjpeg, .width_px = 64, .height_px = 64, .bytes = std::span{bytes}.first(size)},
            picture))
            << size << " of " << bytes.size();
}

TEST(Decode, JpegOfAnotherSizeIsRefused) {
    const auto bytes = jpeg(red_and_white(64, 32));
    PictureDecoder decoder;
    Picture picture;
    ASSERT_FALSE(
        decoder.decode({.format = PixelFormat::mjpeg, .width_px = 32, .height_px = 32, .bytes = bytes}, picture));
    EXPECT_THAT(decoder.error(), HasSubstr("64x32 and not 32x32"));
}

TEST(Decode, YuyvHasItsColoursAndSkipsThePaddingOfRows) {
    constexpr int width = 4, height = 2, stride = 12;
    std::vector<std::uint8_t> bytes(stride * height, 0);
    for (const int row : {0, 1})
        for (const int pair : {0, 1}) { // BT.601: red is Y 81, U 90, V 240
            const std::size_t at = static_cast<std::size_t>(row * stride + 4 * pair);
            bytes[at] = bytes[at + 2] = 81;
            bytes[at + 1] = 90;
            bytes[at + 3] = 240;
        }
    PictureDecoder decoder;
    Picture picture;
    ASSERT_TRUE(decoder.decode(
        {.format = PixelFormat::yuyv, .width_px = width, .height_px = height, .stride_bytes = stride, .bytes = bytes},
        picture));
    for (const int x : {0, 3}) expect_colour(picture, x, 1, {0, 0, 255});
}

TEST(Decode, Nv12HasItsColours) {
    constexpr int width = 4, height = 4, stride = 8;
    std::vector<std::uint8_t> bytes(stride * height * 3 / 2, 81);
    for (std::size_t at = stride * height; at < bytes.size(); at += 2) {
        bytes[at] = 90;
        bytes[at + 1] = 240;
    }
    PictureDecoder decoder;
    Picture picture;
    ASSERT_TRUE(decoder.decode(
        {.format = PixelFormat::nv12, .width_px = width, .height_px = height, .stride_bytes = stride, .bytes = bytes},
        picture));
    expect_colour(picture, 3, 3, {0, 0, 255});
}

TEST(Decode, GreyStaysGrey) {
    const std::vector<std::uint8_t> bytes{1, 2, 99, 3, 4, 99};
    PictureDecoder decoder;
    Picture picture;
    ASSERT_TRUE(decoder.decode(
        {.format = PixelFormat::grey, .width_px = 2, .height_px = 2, .stride_bytes = 3, .bytes = bytes}, picture));
    EXPECT_EQ(picture.channels, 1);
    EXPECT_EQ(picture.pixels, (std::vector<std::uint8_t>{1, 2, 3, 4}));
}

TEST(Decode, SizesThatCannotBeAreRefused) {
    const std::vector<std::uint8_t> bytes(64);
    PictureDecoder decoder;
    Picture picture;
    const auto refused = [&](RawImage raw) {
        raw.bytes = bytes;
        return !decoder.decode(raw, picture) && picture.empty();
    };
    EXPECT_TRUE(refused({PixelFormat::grey, 0, 4, 4, {}}));
    EXPECT_TRUE(refused({PixelFormat::grey, 4, -1, 4, {}}));
    EXPECT_TRUE(refused({PixelFormat::grey, 1'000'000, 1'000'000, 1'000'000, {}}));
    EXPECT_TRUE(refused({PixelFormat::grey, 8, 8, 7, {}})) << "rows overlap";
    EXPECT_TRUE(refused({PixelFormat::grey, 8, 9, 8, {}})) << "a row is missing";
    EXPECT_TRUE(refused({PixelFormat::yuyv, 8, 4, 8, {}})) << "two bytes a pixel";
    EXPECT_TRUE(refused({PixelFormat::yuyv, 3, 2, 6, {}})) << "odd";
    EXPECT_TRUE(refused({PixelFormat::nv12, 8, 8, 8, {}})) << "no colours";
}

} // namespace
} // namespace locus::camera
