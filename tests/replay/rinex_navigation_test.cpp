// Navigation files turned into the words that the satellites broadcast: decoded again, the words give every number that
// stands in the file, to its last digit.
#include "fusion/gnss/ephemeris_words.h"
#include "tests/replay/data.h"
#include "tests/replay/navigation_records.h"
#include "tests/replay/printed_ephemeris.h"

#include <gtest/gtest.h>

namespace locus::gnss {
namespace {

std::optional<Ephemeris> decoded(const rinex::NavigationRecord& record) {
    EphemerisCollector collector;
    std::optional<Ephemeris> last;
    for (const auto& words : encode(record.ephemeris, record.sent, record.leap_s))
        last = collector.add(words, record.sent);
    return last;
}

class NavigationFile : public testing::TestWithParam<std::pair<const char*, std::size_t>> {};

TEST_P(NavigationFile, ComesBackToTheDigit) {
    const auto& [name, count] = GetParam();
    const auto path = test::recorded(name);
    if (!path) GTEST_SKIP() << "no " << name << " in LOCUS_DATA or ../shared/data";
    const auto ours = test::read_navigation_records(*path).records;
    const auto printed = test::read_rinex_records(*path);
    ASSERT_EQ(ours.size(), count);
    ASSERT_EQ(printed.size(), count);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto again = decoded(ours[i]);
        ASSERT_TRUE(again) << printed[i].satellite;
        test::expect_same(printed[i].satellite, *again, printed[i].numbers, true);
        ++compared;
    }
    std::printf("%s: %zu records\n", name, compared);
}

INSTANTIATE_TEST_SUITE_P(OfHongKongAndIgs, NavigationFile,
                         testing::Values(std::pair{"graphgnss_hk_tst/gps_solution_TST/hksc1180.19n", std::size_t{203}},
                                         std::pair{"graphgnss_hk_tst/gps_solution_TST/hksc1180.19b", std::size_t{356}},
                                         std::pair{"google_gnss/opensource/demoFiles/hour1820.16n", std::size_t{418}},
                                         std::pair{"google_gnss/opensource/demoFiles/hour2350.16n", std::size_t{419}}));

} // namespace
} // namespace locus::gnss
