// Section "cameras": each a source and, side by side with its options in the same map, either a detector and a tracker
// or, where it is worn, the odometry's.
#include "config/names.h"
#include "config/print_options.h"
#include "config/section.h"
#include "config/uniques.h"

#include <fmt/format.h>

namespace locus::config {
namespace {

void find_parts(const YamlNode& item, CameraInputSettings& camera, Problems& problems) {
    camera.source = find_named(item.find("source"), "source", camera::frame_source_table(), problems);
    const bool is_worn = item.find("worn_by") != nullptr;
    if (!is_worn) camera.detector = find_named(item.find("detector"), "detector", camera::detector_table(), problems);
    if (camera.source) camera.source_settings = camera.source->options.make();
    if (camera.detector) camera.detector_settings = camera.detector->options.make();
}

/// What may stand in the map although its table was not found.
std::vector<std::string_view> keys_of_unknown_parts(const CameraInputSettings& camera, bool is_worn) {
    std::vector<std::string_view> keys;
    const auto append = [&](const auto& table) {
        for (const auto& row : table) append_names({row.options.rows, nullptr, row.options.lists}, keys);
    };
    if (!camera.source) append(camera::frame_source_table());
    if (!camera.detector && !is_worn) append(camera::detector_table());
    return keys;
}

void check_detector(const YamlNode& item, const CameraInputSettings& camera, Problems& problems) {
    if (!camera.detector || !camera.detector->options.check) return;
    const std::string wrong = camera.detector->options.check(camera.detector_settings.get());
    if (!wrong.empty()) problems.add(item.mark, fmt::format("camera {}: {}", shown(camera.name), wrong));
}

/// Its lens is needed: without it no way can be told at all.
void check_worn(const YamlNode& item, const CameraInputSettings& camera, Problems& problems) {
    if (!camera.calibration.empty()) return;
    problems.add(item.mark, fmt::format("camera {} is worn, so it needs the calibration of its lens: `locus calibrate "
                                        "camera chessboard` makes it",
                                        shown(camera.name)));
}

void check_device(const YamlNode& item, const CameraInputSettings& camera, Uniques& devices, Problems& problems) {
    if (!camera.enabled || !camera.source || camera.source->sole_option.empty()) return;
    const YamlNode* device = item.find(camera.source->sole_option);
    if (device && !device->text.empty()) devices.check(device->text, device->mark, problems);
}

void read_camera(const YamlNode& item, CameraInputSettings& camera, Problems& problems) {
    find_parts(item, camera, problems);
    std::vector<BoundOptions> tables{{camera_input_options, &camera}};
    const auto bind = [&](const OptionTable& table, const std::shared_ptr<void>& settings) {
        tables.push_back({table.rows, settings.get(), table.lists});
    };
    if (camera.source) bind(camera.source->options, camera.source_settings);
    const bool is_worn = item.find("worn_by") != nullptr;
    if (is_worn)
        tables.push_back({camera::odometer_options, &camera.odometry});
    else
        tables.push_back({onlooker_options, &camera});
    if (camera.detector) bind(camera.detector->options, camera.detector_settings);
    if (!is_worn) tables.push_back({vision::tracker_options, &camera.tracker});
    const std::size_t problems_before = problems.size();
    read_map(item, {"camera", keys_of_unknown_parts(camera, is_worn)}, tables, problems);
    if (problems.size() == problems_before) {
        check_detector(item, camera, problems);
        if (is_worn) check_worn(item, camera, problems);
    }
    check_one_word(item, camera.name, problems);
}

} // namespace

void read_cameras(const YamlNode& node, std::vector<CameraInputSettings>& cameras, Problems& problems) {
    Uniques names("camera with the name");
    Uniques devices("camera that reads", ", which only one can");
    for (const auto& item : list_items(node, max_cameras, problems)) {
        CameraInputSettings& camera = cameras.emplace_back();
        read_camera(item, camera, problems);
        if (!camera.name.empty()) names.check(camera.name, item.mark, problems);
        check_device(item, camera, devices, problems);
    }
}

std::string print_cameras(const std::vector<CameraInputSettings>& cameras) {
    if (cameras.empty()) return "cameras: []\n";
    std::string text = "cameras:\n";
    for (const auto& camera : cameras) {
        const auto shown = [](const OptionTable& table, const std::shared_ptr<void>& settings) {
            return ShownOptions{table.rows, settings.get(), table.lists};
        };
        std::vector<ShownOptions> tables{{camera_input_options, &camera},
                                         shown(camera.source->options, camera.source_settings)};
        if (camera.is_worn()) {
            tables.push_back({camera::odometer_options, &camera.odometry});
        } else {
            tables.push_back({onlooker_options, &camera});
            tables.push_back(shown(camera.detector->options, camera.detector_settings));
            tables.push_back({vision::tracker_options, &camera.tracker});
        }
        text += print_block(tables, 2, true);
    }
    return text;
}

} // namespace locus::config
