// Wake: an eventfd that one thread raises and another's epoll or ppoll hears. Raising never blocks.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace locus {

class Wake {
  public:
    /// Throws std::system_error when the process has no descriptor left.
    Wake() : fd_{::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)} {
        if (fd_.get() < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
    }

    /// Any thread; one system call.
    void raise() const noexcept {
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto sent = ::write(fd_.get(), &one, sizeof one); // full: raised already
    }

    /// Back to quiet.
    void hush() const noexcept {
        std::uint64_t count = 0;
        [[maybe_unused]] const auto got = ::read(fd_.get(), &count, sizeof count);
    }

    int fd() const noexcept { return fd_.get(); }

  private:
    UniqueFd fd_;
};

} // namespace locus
