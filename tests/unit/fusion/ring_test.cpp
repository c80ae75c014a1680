#include "fusion/ring.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace locus {
namespace {

TEST(Ring, DropsTheNewItemWhenFullAndCountsIt) {
    Ring<int, 2> ring;
    EXPECT_TRUE(ring.push(1));
    EXPECT_TRUE(ring.push(2));
    EXPECT_FALSE(ring.push(3));
    EXPECT_EQ(ring.dropped(), 1u);
    int item = 0;
    EXPECT_TRUE(ring.pop(item));
    EXPECT_EQ(item, 1);
    EXPECT_TRUE(ring.pop(item));
    EXPECT_EQ(item, 2);
    EXPECT_FALSE(ring.pop(item));
}

TEST(Ring, TwoThreadsSeeEveryItemInOrderOrItIsCountedAsDropped) {
    static Ring<std::uint64_t, 64> ring;
    constexpr std::uint64_t items = 200'000;
    std::thread producer([] {
        for (std::uint64_t i = 1; i <= items; ++i)
            while (!ring.push(i) && i % 2 == 0) std::this_thread::yield(); // odd items may be lost, even ones not
        while (!ring.push(items + 1)) std::this_thread::yield();
    });
    std::uint64_t last = 0, seen = 0, even = 0;
    while (last != items + 1) {
        std::uint64_t item = 0;
        if (!ring.pop(item)) continue;
        ASSERT_GT(item, last);
        last = item;
        ++seen;
        even += item <= items && item % 2 == 0;
    }
    producer.join();
    EXPECT_EQ(even, items / 2);
    EXPECT_GE(ring.dropped() + seen, items + 1);
}

} // namespace
} // namespace locus
