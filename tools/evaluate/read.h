// Tracks from files: TUM lines (t x y z qx qy qz qw) or POSE lines of docs/protocol.md.
#pragma once

#include "tools/evaluate/track.h"

#include <iosfwd>
#include <stdexcept>
#include <string>

namespace locus::evaluate {

/// what() is "FILE:LINE: sentence", or "FILE: sentence" where no line is to blame.
class FileError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What becomes of a second line of the same time: a mistake in an estimate, but known of public truth files whose
/// times are rounded, where the first line is as good as the second.
enum class RepeatedTime { refused, passed_over };

/// Seconds, metres and a quaternion that is read but not used; the quaternion may be missing. Blank lines and lines
/// that begin with '#' are passed over. Throws FileError.
Track read_tum(std::istream& stream, const std::string& name, RepeatedTime repeated = RepeatedTime::refused);

/// JSON lines; of class POSE those of `target` are taken, lines of other classes are passed over. With an empty
/// `target` the file may hold one target only. Throws FileError.
Track read_pose_lines(std::istream& stream, const std::string& name, const std::string& target);

/// A TUM file. Throws FileError.
Track read_truth(const std::string& path);

/// A TUM file or POSE lines, told apart by the first character. Throws FileError.
Track read_estimate(const std::string& path, const std::string& target = "");

} // namespace locus::evaluate
