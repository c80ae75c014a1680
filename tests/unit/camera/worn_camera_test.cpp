// What the daemon makes of a camera that is worn: measurements of the wearer's tag, and a sentence where it cannot.
#include "daemon/camera/worn_camera.h"
#include "tests/support/room/room_film.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace locus {
namespace {

using testing::HasSubstr;

constexpr auto room_lens = "model: pinhole\nwidth_px: 640\nheight_px: 480\nfx_px: 457\nfy_px: 457\ncx_px: 319.5\n"
                           "cy_px: 239.5\n";

CameraInputSettings worn_with(const std::string& calibration) {
    CameraInputSettings settings;
    settings.name = "body";
    settings.worn_by = address(16);
    settings.calibration = calibration;
    return settings;
}

camera::Frame room_frame(camera::Picture picture, double time_s) {
    camera::Frame frame;
    frame.picture = std::move(picture);
    frame.captured = timestamp_from_s(time_s);
    return frame;
}

TEST(WornCamera, TellsTheWayOfItsWearer) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "lens.yaml") << room_lens;
    WornCamera worn(worn_with(folder / "lens.yaml"));
    const room::RoomScene scene(4, {9, 7, 2.8});
    const room::RoomWalk walk;
    room::RoomFilm film(scene, walk, 4);
    worn.look(room_frame(film.at(0), 0), address(2));
    EXPECT_THAT(worn.doing(), HasSubstr("starting"));
    std::optional<VisualOdometry> told;
    for (int i = 1; i < 20; ++i) told = worn.look(room_frame(film.at(i / 15.), i / 15.), address(2));
    EXPECT_THAT(worn.doing(), HasSubstr("tracking"));
    EXPECT_EQ(worn.trouble(), "");
    ASSERT_TRUE(told.has_value());
    EXPECT_EQ(told.value().tag, address(16));
    EXPECT_EQ(told.value().camera, address(2));
    const std::uint32_t segment = told.value().segment;
    for (int i = 20; i < 32; ++i) EXPECT_FALSE(worn.look(room_frame(film.covered(), i / 15.), address(2)).has_value());
    EXPECT_THAT(worn.doing(), HasSubstr("lost"));
    EXPECT_THAT(worn.trouble(), HasSubstr("begins anew"));
    for (int i = 32; i < 50; ++i) told = worn.look(room_frame(film.at(i / 15.), i / 15.), address(2));
    ASSERT_TRUE(told.has_value());
    EXPECT_EQ(told.value().segment, segment + 1);
    EXPECT_EQ(worn.trouble(), "");
}

TEST(WornCamera, NeedsALensOfTheSameShape) {
    const test::TemporaryFolder folder;
    WornCamera blind(worn_with("/nowhere/lens.yaml"));
    camera::Picture picture;
    picture.resize(640, 360, 1);
    EXPECT_FALSE(blind.look(room_frame(picture, 0), address(0)).has_value());
    EXPECT_THAT(blind.trouble(), HasSubstr("/nowhere/lens.yaml"));
    std::ofstream(folder / "lens.yaml") << room_lens;
    WornCamera other(worn_with(folder / "lens.yaml"));
    EXPECT_FALSE(other.look(room_frame(picture, 0), address(0)).has_value());
    EXPECT_THAT(other.trouble(), HasSubstr("640x360"));
}

} // namespace
} // namespace locus
