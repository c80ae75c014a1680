#include "daemon/socket/line_queue.h"

#include <algorithm>
#include <utility>

namespace locus {
namespace {
/// As much as one write takes at a time; little, because what is staged can no longer be dropped.
constexpr std::size_t stage_bytes = 8192;
} // namespace

void LineQueue::push_pose(OpenLine line) {
    if (poses() >= max_poses_) drop_oldest_pose();
    lines_.push_back({std::move(line), {}});
}

void LineQueue::push_answer(std::string lines) {
    lines_.push_back({nullptr, std::move(lines)});
    ++answers_;
}

void LineQueue::drop_oldest_pose() {
    const auto oldest = std::ranges::find_if(lines_, [](const Line& line) { return line.pose != nullptr; });
    lines_.erase(oldest);
    ++dropped_;
    ++dropped_untold_;
}

std::string_view LineQueue::front() {
    if (sent_ == outgoing_.size()) {
        outgoing_.clear();
        sent_ = 0;
        while (!lines_.empty() && outgoing_.size() < stage_bytes) {
            stage(lines_.front());
            lines_.pop_front();
        }
    }
    return std::string_view{outgoing_}.substr(sent_);
}

void LineQueue::stage(const Line& line) {
    if (!line.pose) {
        outgoing_ += line.answer;
        --answers_;
        return;
    }
    outgoing_ += *line.pose;
    if (const auto lost = std::exchange(dropped_untold_, 0)) outgoing_ += ",\"dropped\":" + std::to_string(lost);
    outgoing_ += "}\n";
}

void LineQueue::written(std::size_t bytes) { sent_ += std::min(bytes, outgoing_.size() - sent_); }

} // namespace locus
