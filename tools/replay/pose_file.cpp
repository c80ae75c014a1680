#include "tools/replay/pose_file.h"

#include "daemon/socket/pose_line.h"
#include "drivers/recording/stamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace locus::replay {
namespace {

std::runtime_error trouble(const std::string& path) {
    return std::runtime_error(fmt::format("'{}' cannot be written: {}", path, std::strerror(errno)));
}

class TextFile : public PoseFile {
  public:
    explicit TextFile(const std::string& path) : path_(path), file_(path, std::ios::trunc) {
        if (!file_) throw trouble(path_);
    }
    void close() override {
        file_.close();
        if (!file_) throw trouble(path_);
    }

  protected:
    void put(std::string_view line) { file_ << line << '\n'; }
    const std::string& path() const { return path_; }

  private:
    std::string path_;
    std::ofstream file_;
};

/// Not known is written as no turn at all: the format has no word for it.
std::array<double, 4> orientation_or_identity(const std::array<double, 4>& xyzw) {
    const bool known = std::ranges::any_of(xyzw, [](double value) { return value != 0; });
    return known ? xyzw : std::array<double, 4>{0, 0, 0, 1};
}

class TumFile final : public TextFile {
  public:
    using TextFile::TextFile;

    void write(const Pose& pose, std::string_view target) override {
        if (target_.empty()) target_ = target;
        if (target_ != target)
            throw std::runtime_error(fmt::format("'{}' would hold both '{}' and '{}', and TUM lines cannot tell them "
                                                 "apart: choose one with --target, or write .jsonl",
                                                 path(), target_, target));
        const auto& p = pose.estimate.position_site_m;
        const auto q = orientation_or_identity(pose.estimate.orientation_xyzw);
        std::string line;
        append_seconds(line, pose.estimate.time);
        fmt::format_to(std::back_inserter(line), " {:.6f} {:.6f} {:.6f} {:.9f} {:.9f} {:.9f} {:.9f}", p[0], p[1], p[2],
                       q[0], q[1], q[2], q[3]);
        put(line);
    }

  private:
    std::string target_;
};

class PoseLineFile final : public TextFile {
  public:
    using TextFile::TextFile;

    void write(const Pose& pose, std::string_view target) override {
        put(open_pose_line(pose, target, pose.estimate.reset_count) + '}');
    }
};

} // namespace

std::unique_ptr<PoseFile> open_pose_file(const std::string& path) {
    if (path.ends_with(".tum")) return std::make_unique<TumFile>(path);
    if (path.ends_with(".jsonl")) return std::make_unique<PoseLineFile>(path);
    throw std::runtime_error("'" + path + "': poses are written as .tum or as .jsonl, so its name must end in one");
}

} // namespace locus::replay
