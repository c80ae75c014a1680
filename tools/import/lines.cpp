#include "tools/import/lines.h"

#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace locus::importing {

std::ifstream opened(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    const bool readable = file && (file.peek() != std::ifstream::traits_type::eof() || file.eof()); // a folder is not
    if (!readable) throw std::runtime_error("'" + path + "' cannot be read: " + std::strerror(errno));
    file.clear();
    return file;
}

bool Lines::next(std::string_view& line) {
    file_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    auto length = static_cast<std::size_t>(file_.gcount());
    if (file_.eof() && length == 0) return false;
    ++number_;
    if (file_.fail() && !file_.eof()) {
        file_.clear();
        file_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    } else if (!file_.eof()) {
        --length; // the newline counts
    }
    if (length > 0 && buffer_[length - 1] == '\r') --length;
    line = {buffer_.data(), length};
    return true;
}

} // namespace locus::importing
