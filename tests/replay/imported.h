// Files of receivers as `locus import` makes them a recording.
#pragma once

#include "drivers/recording/measurement_json.h"
#include "tests/support/temporary_folder.h"
#include "tools/import/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace locus::test {

struct Imported {
    std::vector<importing::FileReport> reports;
    std::vector<Measurement> measurements;
    std::map<std::string_view, std::size_t> counts;
};

inline Imported import(const std::vector<std::filesystem::path>& paths) {
    const TemporaryFolder folder;
    importing::Request request{{}, folder / "recording.jsonl"};
    for (const auto& path : paths) request.files.push_back(path.string());
    Imported imported;
    imported.reports = importing::import_files(request);
    std::ifstream file(request.output);
    std::string error;
    for (std::string line; std::getline(file, line);) {
        const auto measurement = from_json_line(line, error);
        EXPECT_TRUE(measurement) << error;
        if (measurement) imported.measurements.push_back(*measurement);
    }
    for (const auto& m : imported.measurements) ++imported.counts[observation_names[m.observation.index()]];
    const bool in_order = std::ranges::is_sorted(imported.measurements, {}, &Measurement::time);
    EXPECT_TRUE(in_order || paths.size() == 1);
    return imported;
}

} // namespace locus::test
