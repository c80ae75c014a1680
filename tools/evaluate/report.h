// An evaluation in words and as JSON.
#pragma once

#include "tools/evaluate/associate.h"
#include "tools/evaluate/statistics.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace locus::evaluate {

struct Evaluation {
    Association association;
    Alignment alignment = Alignment::none;
    Similarity similarity;
    Statistics statistics;
};

/// Lines of text for people.
std::vector<std::string> report_lines(const Evaluation& evaluation);

/// One object, class EVALUATION, lengths in metres and shares from 0 to 1.
nlohmann::json report_json(const Evaluation& evaluation);

} // namespace locus::evaluate
