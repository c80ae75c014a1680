// What both ways of naming tracks must do: undo a wrong name when the evidence turns, tell by looks where places do
// not, and live with fixed memory.
#include "fusion/vision/association_matrix.h"
#include "fusion/vision/identity.h"
#include "tests/allocations.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace locus::vision {
namespace {

constexpr double image_step_s = 0.1;
constexpr std::size_t tag_room = 8;

Looks dressed_in(std::size_t colour) {
    Looks looks{};
    looks[colour] = 230;
    looks[20] = 110; // trousers that everybody wears
    return looks;
}

SeenPerson person_at(std::uint32_t track, double x_m, const Looks& looks = {}) {
    return {track, {x_m, 0}, 0.04 * Eigen::Matrix2d::Identity(), looks};
}
LocatedTag located_at(std::uint64_t number, double x_m) {
    return {address(number), {x_m, 0}, 0.04 * Eigen::Matrix2d::Identity()};
}

class NamingTest : public testing::TestWithParam<std::string> {
  protected:
    NamingTest() {
        IdentitySettings identity;
        identity.looks_weight = 5;
        if (GetParam() == "matrix")
            naming_ = std::make_unique<AssociationMatrix>(AssociationSettings{}, tag_room, CameraLooks(book_, 0));
        else
            naming_ = std::make_unique<Identity>(identity, tag_room, CameraLooks(book_, 0));
    }

    std::vector<std::optional<Address>> run(double seconds, const std::vector<SeenPerson>& people,
                                            const std::vector<LocatedTag>& tags) {
        std::vector<std::optional<Address>> names;
        for (double end_s = time_s_ + seconds; time_s_ < end_s; time_s_ += image_step_s) {
            names.clear();
            for (const Named& named : naming_->update(timestamp_from_s(time_s_), people, tags)) {
                EXPECT_GE(named.confidence, 0);
                EXPECT_LE(named.confidence, 1);
                names.push_back(named.tag);
            }
        }
        return names;
    }

    LookBook book_{1, tag_room};
    std::unique_ptr<Naming> naming_;
    double time_s_ = 1;
};

TEST_P(NamingTest, UndoesAWrongNameWhenTheEvidenceTurns) {
    const std::vector<SeenPerson> people{person_at(1, 0), person_at(2, 6)};
    auto names = run(10, people, {located_at(7, 0.2), located_at(8, 6.2)});
    EXPECT_EQ(names[0], address(7));
    EXPECT_EQ(names[1], address(8));
    names = run(10, people, {located_at(7, 6.2), located_at(8, 0.2)}); // the tracker has swapped the two
    EXPECT_EQ(names[0], address(8));
    EXPECT_EQ(names[1], address(7));
}

TEST_P(NamingTest, TakesANameBackFromWhomTheTagLeaves) {
    const std::vector<SeenPerson> people{person_at(1, 0)};
    EXPECT_EQ(run(10, people, {located_at(7, 0.2)})[0], address(7));
    EXPECT_FALSE(run(10, people, {located_at(7, 9)})[0].has_value());
}

TEST_P(NamingTest, KnowsPeopleAgainByTheirLooksWhereAllAreNear) {
    const Looks red = dressed_in(0), blue = dressed_in(5);
    run(20, {person_at(1, 0, red), person_at(2, 6, blue)}, {located_at(7, 0), located_at(8, 6)});
    // They come together, the tracker loses them, and the tags say next to nothing.
    const std::vector<LocatedTag> tags{located_at(7, 3.02), located_at(8, 2.98)};
    const auto names = run(10, {person_at(11, 2.95, blue), person_at(12, 3.05, red)}, tags);
    EXPECT_EQ(names[0], address(8));
    EXPECT_EQ(names[1], address(7));
}

TEST_P(NamingTest, ForgetsTracksThatLeftAndHasFixedMemory) {
    std::vector<SeenPerson> people(max_people + 10);
    std::vector<LocatedTag> tags;
    for (std::uint64_t i = 0; i < 2 * tag_room; ++i) tags.push_back(located_at(i, static_cast<double>(i)));
    std::uint32_t track = 0;
    const test::AllocationCount count;
    for (int i = 0; i < 300; ++i, time_s_ += image_step_s) {
        for (std::size_t k = 0; k < people.size(); ++k) people[k] = person_at(++track, static_cast<double>(k % 20));
        EXPECT_EQ(naming_->update(timestamp_from_s(time_s_), people, tags).size(), max_people);
    }
    EXPECT_EQ(count.made(), 0u);
    EXPECT_EQ(run(10, {person_at(++track, 3)}, {located_at(3, 3)})[0], address(3)) << "there is a place again";
}

TEST_P(NamingTest, NumbersThatAreNoneProveNothing) {
    EXPECT_FALSE(run(5, {person_at(1, std::nan(""))}, {located_at(7, 0)})[0].has_value());
    EXPECT_FALSE(run(5, {person_at(1, 0)}, {located_at(7, std::nan(""))})[0].has_value());
}

INSTANTIATE_TEST_SUITE_P(Both, NamingTest, testing::Values("hungarian", "matrix"),
                         [](const auto& which) { return which.param; });

} // namespace
} // namespace locus::vision
