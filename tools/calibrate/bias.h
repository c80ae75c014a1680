// `locus calibrate bias` in words: a recorded walk in, each anchor's range bias out, and how sure that is.
#pragma once

#include "config/settings.h"
#include "fusion/uwb/survey/walk.h"
#include "tools/calibrate/merge.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace locus::calibrate {

struct BiasRequest {
    std::string file;
    std::string config;
    std::string truth;  ///< TUM file; empty: the path is estimated with the biases
    std::string target; ///< name or address; empty: the only one there is
    double sigma_m = 0.1;
    uwb::survey::WalkSettings walk;
};

struct Walk {
    std::vector<Anchor> anchors;                ///< of the settings, all of them
    std::vector<uwb::survey::WalkRange> ranges; ///< of one target, in order of time
    std::vector<std::string> notes;
};

/// Throws std::runtime_error with a sentence when there is no file, no range, or more than one target to choose from.
Walk read_walk(const BiasRequest& request, const Settings& settings);

struct BiasReport {
    Walk walk;
    uwb::survey::Biases biases;
    bool with_truth = false;
};

/// Throws std::runtime_error with a sentence when the walk has no path to start from, or the truth does not cover it.
BiasReport calibrate_bias(const BiasRequest& request, const Settings& settings);

std::vector<std::string> report_lines(const BiasReport& report, const BiasRequest& request);
nlohmann::json report_json(const BiasReport& report);

/// Of anchors whose bias the walk told: the rest stay as they are.
std::vector<AnchorEdit> edits_of(const BiasReport& report, const BiasRequest& request);
std::vector<std::string> yaml_lines(const BiasReport& report, const BiasRequest& request);

} // namespace locus::calibrate
