// Any bytes as a file of surveyed floor points: points that are numbers, or one sentence.
#include "tools/calibrate/points_file.h"

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace {

/// A file in memory, with a name that can be opened.
class MemoryFile {
  public:
    MemoryFile(const std::uint8_t* data, std::size_t size) : fd_(memfd_create("points", 0)) {
        if (fd_ < 0 || write(fd_, data, size) != static_cast<ssize_t>(size)) std::abort();
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { close(fd_); }
    std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

  private:
    int fd_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const MemoryFile file(data, size);
    try {
        const auto points = locus::calibrate::read_points(file.path(), 1, 0.01);
        if (points.pairs.size() != points.names.size()) std::abort();
        for (const auto& pair : points.pairs)
            if (!pair.pixel_px.allFinite() || !pair.site_m.allFinite()) std::abort();
    } catch (const std::runtime_error& error) {
        if (std::string_view(error.what()).empty()) std::abort();
    }
    return 0;
}
