#include "tools/calibrate/camera.h"

#include "tools/calibrate/board.h"
#include "tools/calibrate/camera_command.h"
#include "tools/calibrate/camera_walk.h"
#include "tools/calibrate/floor_points.h"

#include <string>

namespace locus::calibrate {
namespace {

CLI::Option* add_lens(CLI::App& app, std::string& path) {
    return app
        .add_option("--camera", path, "Calibration whose lens is taken; without it the floor is seen by a homography")
        ->type_name("FILE");
}

constexpr const char* exit_codes =
    "Exit codes: 0 calibrated, 1 what was measured does not tell (it says what to do), 2 "
    "a file cannot be used.";

void add_board(CLI::App& camera, int& exit_code) {
    CLI::App& app = *camera.add_subcommand("chessboard", "The lens, from images of a chessboard");
    BoardRequest& request = add_command(app, exit_code, calibrate_lens)->request;
    app.add_option("IMAGES", request.images, "Images of the camera, or a folder of them")->required();
    app.add_option("--columns", request.shape.columns, "Inner corners along the board: one less than squares")
        ->check(CLI::Range(3, 100))
        ->capture_default_str();
    app.add_option("--rows", request.shape.rows, "Inner corners across it")
        ->check(CLI::Range(3, 100))
        ->capture_default_str();
    app.add_option("--square-m", request.shape.square_m, "Side of a square; the lens does not depend on it")
        ->check(CLI::Range(0.001, 10.0))
        ->capture_default_str();
    app.add_flag("--fisheye", request.is_fisheye, "A lens that sees 120 degrees and more");
    app.footer(
        std::string("Example:\n  locus calibrate camera chessboard board-*.png --columns 9 --rows 6 --out lens.yaml\n"
                    "Hold the board near, far, in the corners, and tilt it by 20 to 45 degrees to all sides.\n") +
        exit_codes);
}

void add_points(CLI::App& camera, int& exit_code) {
    CLI::App& app = *camera.add_subcommand("points", "The view of the floor, from four or more surveyed points of it");
    PointsRequest& request = add_command(app, exit_code, calibrate_points)->request;
    app.add_option("FILE", request.file, "Lines x_px,y_px,x_m,y_m[,name]: a pixel and its place in the site")
        ->required();
    add_lens(app, request.lens);
    app.add_option("--size", request.size, "Size of the image, where it is not that of --camera")->type_name("WxH");
    app.add_option("--sigma-px", request.sigma_px, "How well a point was found in the image, 1 sigma")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    app.add_option("--sigma-m", request.sigma_m, "How well it was surveyed, 1 sigma")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
    app.footer(std::string("Example:\n  locus calibrate camera points --camera lens.yaml marks.csv --out hall.yaml\n") +
               exit_codes);
}

void add_walk(CLI::App& camera, int& exit_code) {
    CLI::App& app =
        *camera.add_subcommand("walk", "The same and the camera's clock, from one tagged person who walks about");
    CameraWalkRequest& request = add_command(app, exit_code, calibrate_walk)->request;
    app.add_option("--poses", request.poses, "Where the tag was: TUM lines, or JSON lines of `locus watch --json`")
        ->required()
        ->type_name("FILE");
    app.add_option("--target", request.target, "Whose poses, where JSON lines are of several")->type_name("NAME");
    app.add_option("--frames", request.frames, "A video, a folder of images, or a camera (/dev/video0)")->required();
    add_lens(app, request.lens);
    app.add_option("--start", request.start_s,
                   "Of a video or folder: time of its first frame in the poses' clock; "
                   "without it all offsets are tried")
        ->type_name("S");
    app.add_option("--search", request.search_s, "How far the camera's clock may be off")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    app.add_option("--rate-hz", request.rate_hz, "Frames a second, where the video does not say it right")
        ->check(CLI::Range(0.0, 1000.0));
    app.add_option("--seconds", request.seconds, "Of a camera: how long to look")
        ->check(CLI::Range(1.0, 3600.0))
        ->capture_default_str();
    app.add_option("--size", request.size, "Of a camera: which of its sizes")->type_name("WxH");
    app.add_option("--detector", request.detector, "What finds people: motion, hog, hog_motion, network")
        ->capture_default_str();
    app.add_option("--detector-settings", request.detector_settings, "Its settings as YAML")->type_name("FILE");
    app.add_option("--sigma-m", request.pose_sigma_m, "How well a pose is known, 1 sigma")
        ->check(CLI::Range(0.001, 10.0))
        ->capture_default_str();
    app.footer(
        std::string("Examples:\n"
                    "  locus replay walk.log --config hall.yaml --poses walk.tum\n"
                    "  locus calibrate camera walk --poses walk.tum --frames walk.mp4 --start 5120.4 --out cam.yaml\n"
                    "  locus watch --json > walk.jsonl & locus calibrate camera walk --poses walk.jsonl --frames "
                    "/dev/video0\n"
                    "Walk two minutes over all of the floor that the camera sees, with turns and a few stops.\n") +
        exit_codes);
}

} // namespace

void add_camera(CLI::App& calibrate, int& exit_code) {
    CLI::App& app = *calibrate.add_subcommand("camera", "How a camera sees the floor, and by what its clock is off");
    app.require_subcommand(1);
    app.footer("`locus calibrate camera walk --help` and so on tell more; docs/cameras.md tells all.");
    add_board(app, exit_code);
    add_points(app, exit_code);
    add_walk(app, exit_code);
}

} // namespace locus::calibrate
