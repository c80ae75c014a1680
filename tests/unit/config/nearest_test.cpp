#include "config/nearest.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>

namespace locus::config {
namespace {

TEST(EditDistance, CountsTypingErrors) {
    EXPECT_EQ(edit_distance("anchor", "anchor"), 0u);
    EXPECT_EQ(edit_distance("anchor", "Anchor"), 0u);
    EXPECT_EQ(edit_distance("anchor", "anhcor"), 1u);
    EXPECT_EQ(edit_distance("anchor", "anchors"), 1u);
    EXPECT_EQ(edit_distance("anchor", "ancor"), 1u);
    EXPECT_EQ(edit_distance("anchor", "anchir"), 1u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("ca", "abc"), 3u);
}

TEST(EditDistance, IsSymmetricAndBounded) {
    EXPECT_TRUE(rc::check([](const std::string& a, const std::string& b) {
        const auto distance = edit_distance(a, b);
        RC_ASSERT(distance == edit_distance(b, a));
        RC_ASSERT(distance <= std::max(a.size(), b.size()));
        RC_ASSERT(distance >= std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
    }));
}

constexpr std::array<std::string_view, 3> names{"rate_hz", "window_s", "max_targets"};

TEST(Nearest, FindsWhatWasMeant) {
    EXPECT_EQ(nearest("rate", names), "");
    EXPECT_EQ(nearest("rate_z", names), "rate_hz");
    EXPECT_EQ(nearest("windows_s", names), "window_s");
    EXPECT_EQ(nearest("maxtarget", names), "max_targets");
}

TEST(Nearest, SaysNothingRatherThanNonsense) {
    EXPECT_EQ(nearest("colour", names), "");
    EXPECT_EQ(hint("colour", names), "; known here: rate_hz, window_s, max_targets");
    EXPECT_EQ(hint("colour", {}), "; none are known here");
}

} // namespace
} // namespace locus::config
