// A recording through the engine: what went in, what became of it, and where the poses went.
#pragma once

#include "config/settings.h"
#include "fusion/anchor_report.h"
#include "fusion/pose.h"
#include "tools/replay/recording.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace locus::replay {

struct Request {
    std::string recording;
    std::vector<std::string> pose_files;
    std::string target; ///< only this one's poses; empty: all
    bool smooth = false;
    bool lagged = false; ///< those of fusion.smooth_lag_s ago, in place of the newest
};

struct Summary {
    struct Target {
        std::uint64_t poses = 0;
        Timestamp first{}, last{};               ///< of its poses
        Missing missing = Missing::measurements; ///< at the end
    };

    ReadReport read;
    EngineCounters engine;
    std::uint64_t one_way = 0; ///< measurements that could not be run backwards for smoothing
    std::optional<Timestamp> first_arrival;
    Timestamp last_arrival{};
    std::map<std::string, Target> targets;
    std::vector<std::pair<std::string, AnchorReport>> anchors; ///< as they were at the end

    bool has_poses() const;
};

/// Throws std::runtime_error with a sentence when a file cannot be read or written, std::invalid_argument when the
/// engine cannot work with the settings.
Summary replay(const Settings& settings, const Request& request);

/// The summary for people, and as one JSON object.
std::vector<std::string> summary_lines(const Summary& summary);
std::string summary_json(const Summary& summary);

/// Why there is no pose: a sentence for each target.
std::vector<std::string> what_is_missing(const Summary& summary);

} // namespace locus::replay
