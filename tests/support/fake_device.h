// A pseudo-terminal in place of a device.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

namespace locus::test {

/// A pseudo-terminal whose far end a link points at, as udev's names do. Destroyed, it is unplugged.
class FakeDevice {
  public:
    explicit FakeDevice(const std::string& link) : link_{link}, master_{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)} {
        ::grantpt(master_.get());
        ::unlockpt(master_.get());
        termios terminal{};
        ::tcgetattr(master_.get(), &terminal);
        ::cfmakeraw(&terminal);
        ::tcsetattr(master_.get(), TCSANOW, &terminal);
        char name[128];
        ::ptsname_r(master_.get(), name, sizeof name);
        std::filesystem::remove(link_);
        std::filesystem::create_symlink(name, link_);
    }
    /// What was written to it within two seconds, at most 64 bytes.
    std::string received() const {
        pollfd waiting{master_.get(), POLLIN, 0};
        std::array<char, 64> bytes{};
        if (::poll(&waiting, 1, 2000) <= 0) return {};
        const ssize_t size = ::read(master_.get(), bytes.data(), bytes.size());
        return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
    }
    ~FakeDevice() { std::filesystem::remove(link_); }
    FakeDevice(const FakeDevice&) = delete;
    FakeDevice& operator=(const FakeDevice&) = delete;

    bool send(const std::string& bytes) const {
        return ::write(master_.get(), bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
    }

  private:
    std::string link_;
    UniqueFd master_;
};

} // namespace locus::test
