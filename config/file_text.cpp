#include "config/file_text.h"
#include "config/yaml_tree.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace locus::config {
namespace {

class File {
  public:
    /// Does not wait for the writer of a named pipe; where one is there, reading waits for what it has to say.
    explicit File(const std::string& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        if (descriptor_ >= 0) ::fcntl(descriptor_, F_SETFL, O_RDONLY);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

std::string user_name() {
    passwd entry{};
    passwd* found = nullptr;
    std::array<char, 4096> buffer{};
    getpwuid_r(geteuid(), &entry, buffer.data(), buffer.size(), &found);
    return found ? fmt::format("\"{}\" (number {})", found->pw_name, geteuid()) : fmt::format("number {}", geteuid());
}

std::string why_not(const std::string& path, int error_number) {
    if (error_number == EACCES || error_number == EPERM)
        return fmt::format("user {} may not read this file; change its owner or mode (chown, chmod)", user_name());
    if (error_number == ENOENT) return "there is no such file";
    if (error_number == EISDIR) return fmt::format("this is a folder, not a file; try {}/locusd.yaml", path);
    return fmt::format("this file cannot be read: {}", std::generic_category().message(error_number));
}

/// False: errno says why.
bool read_all(int descriptor, std::string& text) {
    std::array<char, 65536> chunk{};
    while (text.size() <= max_file_bytes) {
        const ssize_t count = ::read(descriptor, chunk.data(), chunk.size());
        if (count == 0) return true;
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) text.append(chunk.data(), static_cast<std::size_t>(count));
    }
    return true;
}

} // namespace

std::optional<std::string> read_file(const std::string& path, std::string& error) {
    const File file(path);
    std::string text;
    if (file.descriptor() >= 0 && read_all(file.descriptor(), text)) return text;
    error = why_not(path, errno);
    return std::nullopt;
}

} // namespace locus::config
