// The section nmea: a target that exists, in a site that lies somewhere.
#include "tests/unit/config/load_fixture.h"

#include <gtest/gtest.h>

namespace locus {
namespace {

TEST(NmeaSettings, ATargetOfAnAnchoredSiteIsTold) {
    const auto loaded = load_settings_text(std::string(hall) + "nmea: {target: forklift-7, rate_hz: 1}\n", "f");
    ASSERT_TRUE(loaded.settings.has_value());
    EXPECT_EQ(loaded.settings->nmea.target, "forklift-7"); // NOLINT(bugprone-unchecked-optional-access): the line above
    EXPECT_EQ(loaded.settings->nmea.rate_hz, 1);           // NOLINT(bugprone-unchecked-optional-access)
}

TEST(NmeaSettings, OtherwiseItSaysWhatIsMissing) {
    EXPECT_NE(problem_of(std::string(hall) + "nmea: {target: truck}\n").find("truck is not the name of one of the"),
              std::string::npos);
    constexpr std::string_view nowhere = "site: {name: hall}\ntargets: [{name: a, address: 1}]\nnmea: {target: a}\n";
    EXPECT_NE(problem_of(nowhere).find("nmea needs site.origin"), std::string::npos);
}

} // namespace
} // namespace locus
