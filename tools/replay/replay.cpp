#include "tools/replay/replay.h"

#include "daemon/socket/pose_line.h"
#include "fusion/engine.h"
#include "tools/replay/pose_file.h"
#include "tools/replay/smooth.h"
#include "tools/replay/ticker.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace locus::replay {
namespace {

class Run {
  public:
    Run(const Settings& settings, const Request& request)
        : settings_(settings), request_(request), engine_(settings.engine),
          ticker_(engine_, [this](std::span<const Pose> poses) { take_poses(poses); }) {
        for (const std::string& path : request.pose_files) files_.push_back(open_pose_file(path));
        if (request.smooth) smoother_.emplace(settings.engine);
    }

    Summary go() {
        summary_.read = read_recording(request_.recording, settings_, [this](const Measurement& m, Timestamp arrival) {
            if (!summary_.first_arrival) summary_.first_arrival = summary_.last_arrival = arrival;
            summary_.last_arrival = std::max(summary_.last_arrival, arrival);
            ticker_.take(m, arrival);
            if (smoother_) smoother_->keep(m);
        });
        ticker_.finish();
        if (smoother_) smooth(*smoother_);
        for (const auto& file : files_) file->close();
        summary_.engine = engine_.counters();
        const auto& anchors = engine_.settings().site.anchors;
        for (std::size_t i = 0; i < anchors.size(); ++i)
            summary_.anchors.emplace_back(anchors[i].name, engine_.sources()[i].health);
        return std::move(summary_);
    }

  private:
    void take_poses(std::span<const Pose> poses) {
        for (const Pose& pose : poses) {
            if (const std::string name = name_of(pose); request_.target.empty() || name == request_.target)
                summary_.targets[name].missing = pose.estimate.missing;
            if (!request_.lagged && is_publishable(pose)) take(pose, pose.estimate.time);
        }
        for (const Pose& pose : engine_.smoothed())
            if (request_.lagged && is_publishable(pose)) take(pose, poses.front().estimate.time);
    }

    std::string name_of(const Pose& pose) const { return std::string{engine_.target_name(pose.target_index)}; }

    void take(Pose pose, Timestamp published) {
        const std::string name = name_of(pose);
        if (!request_.target.empty() && name != request_.target) return;
        Summary::Target& target = summary_.targets[name];
        pose.published = published;
        if (target.poses++ == 0) target.first = pose.estimate.time;
        target.last = pose.estimate.time;
        if (smoother_)
            smoother_->keep(pose, name);
        else
            write(pose, name);
    }

    void smooth(Smoother& smoother) {
        smoother.finish([this](const Pose& pose, const std::string& target) { write(pose, target); });
        summary_.one_way = smoother.one_way();
    }

    void write(const Pose& pose, const std::string& target) {
        for (const auto& file : files_) file->write(pose, target);
    }

    const Settings& settings_;
    const Request& request_;
    Engine engine_;
    Ticker ticker_;
    std::vector<std::unique_ptr<PoseFile>> files_;
    std::optional<Smoother> smoother_;
    Summary summary_;
};

} // namespace

bool Summary::has_poses() const {
    return std::ranges::any_of(targets, [](const auto& named) { return named.second.poses > 0; });
}

Summary replay(const Settings& settings, const Request& request) { return Run(settings, request).go(); }

} // namespace locus::replay
