// Poses as a file: TUM lines (`t x y z qx qy qz qw`, what evo and `locus evaluate` read) or the POSE lines of
// docs/protocol.md. The same poses give the same bytes.
#pragma once

#include "fusion/pose.h"

#include <memory>
#include <string>
#include <string_view>

namespace locus::replay {

class PoseFile {
  public:
    virtual ~PoseFile() = default;
    /// Throws std::runtime_error when a second target comes into a file that has no word for targets.
    virtual void write(const Pose& pose, std::string_view target) = 0;
    /// Throws std::runtime_error unless all of it is on the disk.
    virtual void close() = 0;
};

/// The name's end says which: .tum or .jsonl. Throws std::runtime_error with a sentence.
std::unique_ptr<PoseFile> open_pose_file(const std::string& path);

} // namespace locus::replay
