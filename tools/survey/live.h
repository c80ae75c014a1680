// A radio map from a running daemon: somebody walks, and what the daemon says of where and of how strong is gathered.
#pragma once

#include "tools/client/client.h"
#include "tools/survey/collector.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace locus::survey {

struct LiveRequest {
    std::vector<std::string> targets; ///< by name; empty: all
    double seconds = 0;               ///< 0: until interrupted
    std::optional<Vec3> stood_site_m;
    double cell_m = 2;
    Heading heading;
};

/// What came so far, for who walks.
struct LiveProgress {
    std::uint64_t readings = 0, poses = 0;
    std::uint64_t poses_by_radio = 0; ///< that come of signal strength itself: no place to learn it from
};

class LiveSurvey {
  public:
    explicit LiveSurvey(LiveRequest request) : request_(std::move(request)) {}

    /// One line of the daemon; classes other than POSE and READING are passed over.
    void take(const tools::Message& message);
    const LiveProgress& progress() const { return progress_; }
    /// Once, at the end: the way between two poses is known only then.
    Collected finish();

  private:
    struct Heard {
        std::string target;
        double time_s;
        radio::Reading reading;
    };
    void take_pose(const tools::Message& message);
    void take_reading(const tools::Message& message);

    LiveRequest request_;
    LiveProgress progress_;
    std::vector<Heard> heard_;
    std::map<std::string, evaluate::Track> tracks_;
};

/// Asks the daemon for poses and readings and gathers them until the time is over or SIGINT came. `tell` hears of the
/// progress about once a second. Throws tools::DaemonError.
Collected survey_live(tools::Client& client, const LiveRequest& request,
                      const std::function<void(const LiveProgress&)>& tell);

} // namespace locus::survey
