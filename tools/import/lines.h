// Lines of a text file with their numbers, bounded: a binary file is no endless line.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace locus::importing {

/// Throws std::runtime_error with a sentence when the file cannot be read.
std::ifstream opened(const std::string& path);

class Lines {
  public:
    explicit Lines(const std::string& path) : file_{opened(path)} {}

    /// False at the file's end. Without "\n" or "\r\n"; what is longer than 8 kB is cut there.
    bool next(std::string_view& line);
    std::uint64_t number() const { return number_; }

  private:
    std::ifstream file_;
    std::array<char, 8192> buffer_{};
    std::uint64_t number_ = 0;
};

} // namespace locus::importing
