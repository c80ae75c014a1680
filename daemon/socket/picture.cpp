#include "daemon/socket/picture.h"

#include "daemon/socket/pose_line.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

constexpr Duration lateness_span = std::chrono::seconds{10};

double to_us(Duration duration) { return std::chrono::duration<double, std::micro>(duration).count(); }

/// Partly sorts `values`.
double quantile(std::vector<double>& values, double share) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

} // namespace

/// A new engine starts with no target and no source; its first position of a target is a reset of it.
void Picture::follow(Generation generation) {
    if (generation == generation_) return;
    generation_ = generation;
    for (const auto& [address, view] : targets_) resets_before_[address] = view.reset_count() + 1;
    targets_.clear();
    sources_.clear();
}

const TargetView& Picture::take(const PoseItem& item) {
    follow(item.generation);
    TargetView& view = targets_[item.pose.target];
    const auto before = resets_before_.find(item.pose.target);
    view.resets_before = before == resets_before_.end() ? 0 : before->second;
    if (is_publishable(view.pose)) view.previous = view.pose.estimate.time;
    view.pose = item.pose;
    return view;
}

void Picture::take(const SourceItem& item) {
    follow(item.generation);
    if (item.index >= item.count) return;
    sources_.resize(item.count);
    sources_[item.index] = item.status;
}

void Picture::take(const TickItem& item) {
    follow(item.generation);
    tick_ = item;
    recent_.push_back(item);
    while (item.tick - recent_.front().tick > lateness_span) recent_.pop_front();
}

std::optional<TickLateness> Picture::lateness() const {
    if (recent_.empty()) return {};
    std::vector<double> late_us;
    late_us.reserve(recent_.size());
    for (const TickItem& tick : recent_) late_us.push_back(to_us(tick.late));
    const double p50 = quantile(late_us, 0.5), p99 = quantile(late_us, 0.99);
    return TickLateness{p50, p99, *std::ranges::max_element(late_us)};
}

bool is_due(Timestamp previous, Timestamp time, double rate_hz) {
    if (rate_hz <= 0) return true;
    return std::floor(to_s(previous) * rate_hz) != std::floor(to_s(time) * rate_hz);
}

} // namespace locus
