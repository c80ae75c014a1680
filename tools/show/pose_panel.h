// What `locus watch` shows: one line a target, with the newest pose, or what stands in its way.
#pragma once

#include "tools/client/client.h"

#include <map>
#include <string>
#include <vector>

namespace locus::tools {

class PosePanel {
  public:
    /// `only`: names of the targets that are shown; empty for all.
    explicit PosePanel(const Message& version, std::vector<std::string> only = {});

    /// Takes POSE and TARGETS lines, passes over all others.
    void take(const Message& message);

    /// `now_s`: CLOCK_MONOTONIC.
    std::vector<std::string> lines(double now_s) const;

  private:
    struct Row {
        nlohmann::json pose;
        std::string missing; ///< empty while there is a pose
    };

    void take_targets(const nlohmann::json& targets);
    bool wanted(const std::string& name) const;

    std::string title_;
    std::vector<std::string> only_;
    std::map<std::string, Row> rows_;
};

/// One pose as one line of text.
std::string pose_line(const nlohmann::json& pose);

} // namespace locus::tools
