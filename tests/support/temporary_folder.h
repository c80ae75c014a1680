// A folder of one test alone.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace locus::test {

/// It is removed at the end.
class TemporaryFolder {
  public:
    TemporaryFolder() : path_{std::filesystem::temp_directory_path() / "locus-test-XXXXXX"} {
        if (!::mkdtemp(path_.data())) throw std::runtime_error("the test cannot make " + path_);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::string& path() const { return path_; }
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

} // namespace locus::test
