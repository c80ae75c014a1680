// All records of a navigation file.
#pragma once

#include "drivers/gnss/rinex_navigation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace locus::test {

struct NavigationRecords {
    std::vector<gnss::rinex::NavigationRecord> records;
    std::optional<gnss::Klobuchar> ionosphere;
};

inline NavigationRecords read_navigation_records(const std::filesystem::path& path) {
    gnss::rinex::Navigation navigation;
    NavigationRecords all;
    std::string line, error;
    const auto keep = [&](const std::optional<gnss::rinex::NavigationRecord>& record) {
        EXPECT_EQ(error, "") << path << ": " << line;
        if (record) all.records.push_back(*record);
    };
    std::ifstream file(path);
    while (std::getline(file, line)) keep(navigation.read(line, error));
    keep(navigation.finish(error));
    EXPECT_EQ(navigation.passed_over(), 0u);
    all.ionosphere = navigation.ionosphere();
    return all;
}

} // namespace locus::test
