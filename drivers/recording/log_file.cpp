#include "drivers/recording/log_file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <ctime>

namespace locus {
namespace {

/// The stamps are CLOCK_MONOTONIC: without this line nobody could tell later on which day it was.
std::string heading() {
    return fmt::format("# recording begun {:%Y-%m-%dT%H:%M:%SZ}; times are seconds since that computer was started",
                       fmt::gmtime(std::time(nullptr)));
}

} // namespace

bool LogFile::open(const std::string& path, bool overwrite, std::string& error) {
    file_.reset(std::fopen(path.c_str(), overwrite ? "we" : "wxe"));
    if (file_) {
        write_line(heading());
        return true;
    }
    error = errno == EEXIST ? fmt::format("'{}' is there already: take another name, or remove it first", path)
                            : fmt::format("'{}' cannot be written: {}", path, std::strerror(errno));
    return false;
}

void LogFile::write_line(const std::string& line) {
    const std::lock_guard lock{mutex_};
    std::fwrite(line.data(), 1, line.size(), file_.get());
    std::fputc('\n', file_.get());
}

bool LogFile::flush() {
    const std::lock_guard lock{mutex_};
    return std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0;
}

} // namespace locus
