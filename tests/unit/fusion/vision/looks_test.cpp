// How people look: histograms, what is remembered of them in each camera, and how it is carried from one to another.
#include "fusion/vision/look_book.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::vision {
namespace {

/// Somebody's clothes: a few colours, drawn.
Colours clothes(std::mt19937& random) {
    std::uniform_real_distribution<float> share{0, 1};
    Colours drawn = Colours::Zero();
    for (float& part : drawn) part = share(random) < 0.3F ? share(random) : 0.01F;
    return drawn / drawn.sum();
}

/// The same clothes in a picture.
Colours pictured(const Colours& worn, std::mt19937& random) {
    std::uniform_real_distribution<float> noise{0.8F, 1.2F};
    Colours seen = worn;
    for (float& part : seen) part *= noise(random);
    return seen / seen.sum();
}

/// As a camera shows them that sees some colours weakly.
Colours in_other_light(const Colours& worn) {
    Colours seen = worn;
    for (Eigen::Index i = 0; i < seen.size(); i += 2) seen(i) *= 0.25F;
    return seen / seen.sum();
}

TEST(Colours, AreSharesWhateverTheBytes) {
    Looks looks;
    looks.fill(255);
    EXPECT_NEAR(colours_of(looks).value().sum(), 1, 1e-6);
    looks = {};
    EXPECT_FALSE(colours_of(looks).has_value());
    looks[23] = 1;
    EXPECT_EQ(colours_of(looks).value()(23), 1);
}

TEST(Colours, ComeBackFromBytes) {
    std::mt19937 random{1};
    for (int i = 0; i < 100; ++i) {
        const Colours worn = clothes(random);
        EXPECT_LT(bhattacharyya_distance(worn, colours_of(looks_of(worn)).value()), 0.02);
    }
}

TEST(Colours, AreAsFarApartAsTheyHaveNothingInCommon) {
    Looks red{}, blue{}, both{};
    red[0] = both[0] = 200;
    blue[5] = both[5] = 200;
    const Colours p = colours_of(red).value(), q = colours_of(blue).value(), r = colours_of(both).value();
    EXPECT_EQ(bhattacharyya_distance(p, p), 0);
    EXPECT_EQ(bhattacharyya_distance(p, q), 1);
    EXPECT_NEAR(bhattacharyya_distance(p, r), std::sqrt(1 - std::sqrt(0.5)), 1e-6);
}

Timestamp image(int i) { return timestamp_from_s(1 + 0.1 * i); }

TEST(LookBook, TellsTheWearerFromOthersOnceTwoAreKnown) {
    std::mt19937 random{2};
    const Colours anna = clothes(random), ben = clothes(random);
    LookBook book(1, 4);
    EXPECT_EQ(book.doubt(0, address(1), anna), 0);
    for (int i = 0; i < 50; ++i) book.learn(0, address(1), pictured(anna, random), image(i));
    EXPECT_EQ(book.doubt(0, address(1), ben), 0) << "nobody to compare with";
    for (int i = 50; i < 100; ++i) book.learn(0, address(2), pictured(ben, random), image(i));
    EXPECT_LT(book.doubt(0, address(1), pictured(anna, random)), -0.5);
    EXPECT_GT(book.doubt(0, address(1), pictured(ben, random)), 0.5);
    EXPECT_EQ(book.doubt(0, address(3), anna), 0) << "never seen";
    EXPECT_EQ(book.doubt(1, address(1), anna), 0) << "no such camera";
}

TEST(LookBook, ForgetsWhatAWrongNameTaught) {
    std::mt19937 random{3};
    const Colours anna = clothes(random), ben = clothes(random);
    LookBook book(1, 4);
    for (int i = 0; i < 100; ++i) book.learn(0, address(1), ben, image(i));
    for (int i = 100; i < 500; ++i) book.learn(0, address(1), anna, image(i));
    EXPECT_LT(bhattacharyya_distance(book.colours(0, address(1)).value(), anna), 0.1);
}

/// Who passed both cameras teaches how the others look in the second.
TEST(LookBook, CarriesLooksFromOneCameraToAnother) {
    std::mt19937 random{4};
    LookBook book(2, 32);
    const Colours stranger = clothes(random);
    book.learn(0, address(100), stranger, image(0));
    for (std::uint64_t tag = 0; tag < 20; ++tag) {
        if (tag <= 4) {
            EXPECT_FALSE(book.colours(1, address(100)).has_value()) << "too few yet";
        }
        const Colours worn = clothes(random);
        for (int i = 0; i < 20; ++i) {
            book.learn(0, address(tag), pictured(worn, random), image(i));
            book.learn(1, address(tag), pictured(in_other_light(worn), random), image(i));
        }
    }
    const Colours expected = in_other_light(stranger);
    const double carried = bhattacharyya_distance(book.colours(1, address(100)).value(), expected);
    EXPECT_LT(carried, 0.5 * bhattacharyya_distance(stranger, expected));
    EXPECT_NEAR(book.colours(1, address(100)).value().sum(), 1, 1e-5);
}

TEST(LookBook, HasRoomForSoManyTags) {
    std::mt19937 random{5};
    LookBook book(1, 2);
    for (std::uint64_t tag = 0; tag < 5; ++tag) book.learn(0, address(tag), clothes(random), image(0));
    EXPECT_TRUE(book.colours(0, address(1)).has_value());
    EXPECT_FALSE(book.colours(0, address(2)).has_value());
    LookBook none(0, 2);
    none.learn(0, address(1), clothes(random), image(0));
    EXPECT_FALSE(none.colours(0, address(1)).has_value());
}

} // namespace
} // namespace locus::vision
