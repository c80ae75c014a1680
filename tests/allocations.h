// Counts what a thread allocates, for tests that prove a real-time path allocates nothing. It looks at malloc itself,
// because Eigen does not go through operator new. A program that uses it is linked with test_allocations.
#pragma once

#include <cstdint>

namespace locus::test {

std::uint64_t allocations_of_this_thread() noexcept;

/// Allocations that this thread has made since construction.
class AllocationCount {
  public:
    std::uint64_t made() const { return allocations_of_this_thread() - before_; }

  private:
    std::uint64_t before_ = allocations_of_this_thread();
};

} // namespace locus::test
