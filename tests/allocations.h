// Counts what a thread allocates, for tests that prove a real-time path allocates nothing. It looks at malloc itself,
// because Eigen does not go through operator new. Include it in one file of a test program only: it defines malloc.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define LOCUS_SANITIZER_OWNS_MALLOC
#endif
#endif

namespace locus::test {

inline thread_local std::uint64_t allocations_of_this_thread = 0;

/// Allocations that this thread has made since construction.
class AllocationCount {
  public:
    std::uint64_t made() const { return allocations_of_this_thread - before_; }

  private:
    std::uint64_t before_ = allocations_of_this_thread;
};

} // namespace locus::test

#ifdef LOCUS_SANITIZER_OWNS_MALLOC

extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace locus::test {
inline const int hooks_installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { ++allocations_of_this_thread; }, [](const volatile void*) {});
} // namespace locus::test

#else

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
    ++locus::test::allocations_of_this_thread;
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    ++locus::test::allocations_of_this_thread;
    return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
    ++locus::test::allocations_of_this_thread;
    return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    ++locus::test::allocations_of_this_thread;
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
    *block = memalign(alignment, size);
    return *block == nullptr ? ENOMEM : 0;
}
}

#endif
