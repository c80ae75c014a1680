// A radio map from the disk and to it.
#include "config/file_text.h"
#include "config/radio_map.h"
#include "config/radio_map_versions.h"
#include "config/yaml_tree.h"
#include "fusion/estimators/radio_particles.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace locus::config {
namespace {

[[noreturn]] void cannot_write(const std::string& path) {
    throw std::runtime_error(fmt::format("'{}' cannot be written: {}", path, std::generic_category().message(errno)));
}

/// All of it and down to the disk; false: errno says why.
bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno != EINTR) return false;
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::fsync(descriptor) == 0;
}

void write_new(const std::string& path, std::string_view text) {
    constexpr mode_t readable = 0644;
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, readable);
    if (descriptor < 0) cannot_write(path);
    const bool good = write_all(descriptor, text);
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    if (!good) cannot_write(path);
}

} // namespace

std::optional<radio::RadioMap> load_radio_map(const std::string& path, std::vector<ConfigProblem>& problems) {
    std::string error;
    const auto text = read_file(path, error);
    if (!text.has_value()) {
        problems.push_back({path, 0, 0, error});
        return std::nullopt;
    }
    Problems found(path);
    auto map = parse_radio_map(text.value(), found);
    for (ConfigProblem& each : found.take()) problems.push_back(std::move(each));
    return map;
}

void write_radio_map(const std::string& path, const radio::RadioMap& map) {
    const std::string text = radio_map_yaml(map);
    if (text.size() > max_file_bytes)
        throw std::runtime_error(fmt::format("the radio map is longer than the {} bytes that are read back: make its "
                                             "cells larger",
                                             max_file_bytes));
    const std::string beside = path + ".new";
    write_new(beside, text);
    if (std::rename(beside.c_str(), path.c_str()) != 0) cannot_write(path);
}

std::string date_of_today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::now())); }

std::string radio_maps_text(const std::vector<EstimatorSettings>& estimators) {
    std::string text;
    for (const EstimatorSettings& each : estimators) {
        if (each.row->name != radio_particles_row.name) continue;
        const auto& radio = *static_cast<const RadioParticlesSettings*>(each.settings.get());
        const auto& map = radio.surveyed_map ? radio.surveyed_map : radio.radio_map;
        if (map) text += radio_map_yaml(*map);
    }
    return text;
}

void load_radio_maps(std::vector<EstimatorSettings>& estimators, const std::filesystem::path& folder,
                     std::vector<ConfigProblem>& problems) {
    for (EstimatorSettings& each : estimators) {
        if (each.row->name != radio_particles_row.name) continue;
        const auto& given = *static_cast<const RadioParticlesSettings*>(each.settings.get());
        if (given.map.empty()) continue;
        auto map = load_radio_map((folder / given.map).string(), problems);
        if (!map.has_value()) continue;
        const auto own = std::make_shared<RadioParticlesSettings>(given);
        own->radio_map = std::make_shared<const radio::RadioMap>(std::move(map.value()));
        if (!given.calibrated_map.empty()) {
            own->calibrated_map = (folder / given.calibrated_map).string();
            own->grid = std::make_shared<radio::GridInUse>();
            load_taught_map(*own);
        }
        each.settings = own;
    }
}

} // namespace locus::config
