// What waits to be written to one client. Answers are never lost; of poses only so many wait, the oldest go first, and
// the next pose that does go out says how many were lost before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>

namespace locus {

/// A POSE object without its closing '}', made once and shared by all clients that get it.
using OpenLine = std::shared_ptr<const std::string>;

class LineQueue {
  public:
    explicit LineQueue(std::size_t max_poses) : max_poses_{max_poses} {}

    void push_pose(OpenLine line);
    /// One or more whole lines.
    void push_answer(std::string lines);

    /// Bytes to write next; empty when nothing waits. Valid until the next call of any other member.
    std::string_view front();
    /// `bytes` of front() were written.
    void written(std::size_t bytes);

    bool empty() const { return outgoing_.size() == sent_ && lines_.empty(); }
    std::size_t answers() const { return answers_; }
    std::size_t poses() const { return lines_.size() - answers_; }
    /// Poses lost since the connection began.
    std::uint64_t dropped() const { return dropped_; }

  private:
    struct Line {
        OpenLine pose; ///< null: an answer
        std::string answer;
    };
    void drop_oldest_pose();
    void stage(const Line& line);

    std::size_t max_poses_;
    std::deque<Line> lines_;
    std::size_t answers_ = 0;
    std::uint64_t dropped_ = 0;
    std::uint64_t dropped_untold_ = 0;
    std::string outgoing_; ///< staged: a line half written must be finished, so it is no longer in lines_
    std::size_t sent_ = 0;
};

} // namespace locus
