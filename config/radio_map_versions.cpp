#include "config/radio_map_versions.h"

#include "config/radio_map.h"
#include "fusion/radio/calibrated_map.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace locus::config {
namespace {

namespace fs = std::filesystem;

/// A file may say anything of its date; of it a file's name is made.
bool is_date(const std::string& text) {
    return text.size() == 10 && std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || c == '-'; });
}

void keep_other_day(const std::string& path, const std::string& today) {
    std::vector<ConfigProblem> problems;
    std::error_code error;
    if (!fs::exists(path, error)) return;
    const auto before = load_radio_map(path, problems);
    if (!before.has_value() || !is_date(before.value().date)) return set_map_aside(path);
    const std::string& date = before.value().date;
    if (date == today) return;
    fs::remove(path + "." + date, error);
    fs::create_hard_link(path, path + "." + date, error); // PATH itself is there all the time
    if (error) fs::copy_file(path, path + "." + date, fs::copy_options::overwrite_existing, error);
}

void remove_oldest(const std::string& path) {
    const fs::path whole(path);
    const std::string begin = whole.filename().string() + ".";
    std::vector<fs::path> versions;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(whole.has_parent_path() ? whole.parent_path() : ".", error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(begin) && is_date(name.substr(begin.size()))) versions.push_back(entry.path());
    }
    std::ranges::sort(versions);
    for (std::size_t i = 0; i + max_map_versions < versions.size(); ++i) fs::remove(versions[i], error);
}

} // namespace

void load_taught_map(RadioParticlesSettings& settings) {
    settings.surveyed_map = settings.radio_map;
    std::error_code error;
    if (!fs::exists(settings.calibrated_map, error)) return;
    std::vector<ConfigProblem> problems;
    auto taught = load_radio_map(settings.calibrated_map, problems);
    if (!taught.has_value())
        settings.calibration_note = to_string(problems.front());
    else if (!radio::is_of_survey(*settings.surveyed_map, taught.value()))
        settings.calibration_note = settings.calibrated_map + ": it is of another survey than the map";
    else
        settings.radio_map = std::make_shared<const radio::RadioMap>(std::move(taught.value()));
}

void write_map_version(const std::string& path, const radio::RadioMap& map) {
    keep_other_day(path, map.date);
    write_radio_map(path, map);
    remove_oldest(path);
}

void set_map_aside(const std::string& path) {
    std::error_code error; // gone already: as good
    fs::rename(path, path + ".set-aside", error);
}

} // namespace locus::config
