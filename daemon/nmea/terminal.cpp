#include "daemon/nmea/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace locus {
namespace {

constexpr mode_t terminal_mode = 0644;

std::runtime_error terminal_failure(const std::string& link, const char* what) {
    return std::runtime_error(
        fmt::format("{}: {}: {}; is the folder of nmea.link there and writable?", link, what, std::strerror(errno)));
}

/// No echo (our own lines would come back), no translation.
void make_raw_terminal(int fd) {
    termios settings{};
    ::tcgetattr(fd, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(fd, TCSANOW, &settings);
}

void replace_link(const std::string& target, const std::string& link) {
    struct stat status{};
    if (::lstat(link.c_str(), &status) == 0 && !S_ISLNK(status.st_mode))
        throw std::runtime_error(link + ": is there already and is no link; remove it or set nmea.link");
    ::unlink(link.c_str());
    if (::symlink(target.c_str(), link.c_str()) != 0) throw terminal_failure(link, "cannot make the link");
}

} // namespace

NmeaTerminal::NmeaTerminal(const std::string& link) : ours_{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)} {
    std::array<char, 64> name{};
    if (!ours_ || ::grantpt(ours_.get()) != 0 || ::unlockpt(ours_.get()) != 0 ||
        ::ptsname_r(ours_.get(), name.data(), name.size()) != 0)
        throw terminal_failure(link, "cannot make a pseudo-terminal");
    theirs_ = UniqueFd{::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    if (!theirs_) throw terminal_failure(link, "cannot open its pseudo-terminal");
    ::fcntl(ours_.get(), F_SETFL, O_NONBLOCK);
    make_raw_terminal(theirs_.get());
    if (::fchmod(theirs_.get(), terminal_mode) != 0) throw terminal_failure(link, "cannot set its mode");
    replace_link(name.data(), link);
    link_ = link;
}

NmeaTerminal::~NmeaTerminal() {
    if (!link_.empty()) ::unlink(link_.c_str());
}

bool NmeaTerminal::put(std::string_view bytes) const {
    return ::write(ours_.get(), bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

void NmeaTerminal::write(std::string_view lines) {
    std::array<char, 256> typed; // by whoever opened it: gpsd probes for kinds of receivers
    while (::read(ours_.get(), typed.data(), typed.size()) > 0) {
    }
    if (put(lines)) return;
    ::tcflush(theirs_.get(), TCIFLUSH);
    put("\r\n"); // ends the line that may have been cut
    put(lines);
}

} // namespace locus
