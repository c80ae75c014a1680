// The examples that people start from are good files.
#include "config/load.h"
#include "tests/support/source_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace locus {
namespace {

std::vector<std::string> examples() {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() + "/config/examples"))
        if (entry.path().string().find("scenario") == std::string::npos) files.push_back(entry.path().string());
    return files;
}

TEST(Examples, AllLoad) {
    EXPECT_GE(examples().size(), 3u);
    for (const auto& file : examples()) {
        const auto result = load_settings(file);
        EXPECT_TRUE(result.settings);
        for (const auto& problem : result.problems) ADD_FAILURE() << to_string(problem);
        if (result.settings) {
            EXPECT_FALSE(result.settings->inputs.empty()) << file;
            EXPECT_GE(result.settings->engine.site.anchors.size(), 3u) << file;
        }
    }
}

} // namespace
} // namespace locus
