// The one thing that stands between two threads: a single-producer single-consumer ring of fixed size.
// A full ring drops the new item and counts it; it never blocks and never lies.
#pragma once

#include <boost/lockfree/spsc_queue.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace locus {

template <class Item, std::size_t Capacity>
class Ring {
    static_assert(std::is_trivially_copyable_v<Item>);

  public:
    /// Producer side. False when full: the item is lost and counted.
    bool push(const Item& item) noexcept {
        if (queue_.push(item)) return true;
        dropped_.fetch_add(1, std::memory_order_relaxed);
        return false;
    }

    /// Consumer side. False when empty.
    bool pop(Item& item) noexcept { return queue_.pop(item); }

    /// Any thread: items lost since construction.
    std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

    static constexpr std::size_t capacity() noexcept { return Capacity; }

  private:
    boost::lockfree::spsc_queue<Item, boost::lockfree::capacity<Capacity>> queue_;
    alignas(64) std::atomic<std::uint64_t> dropped_{0};
};

} // namespace locus
