// `locus calibrate anchors` in words: what people ask for, what the survey answers, and what only they can know.
#pragma once

#include "fusion/uwb/survey/survey.h"
#include "tools/calibrate/merge.h"
#include "tools/calibrate/pairs.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace locus::calibrate {

/// Which of two mirror images, as people see it from above.
enum class Side { left, right, above, below };

struct AnchorsRequest {
    std::string file;
    std::string config; ///< empty: none
    std::vector<std::string> known;
    bool heights = false;           ///< every anchor's z of the settings is trusted
    std::optional<double> height_m; ///< or all hang at this height
    double sigma_m = 0.1;
    std::optional<Side> beside;  ///< left or right
    std::optional<Side> over_it; ///< above or below
};

/// Throws std::runtime_error with a sentence where names are unknown or settings are missing.
uwb::survey::Task task_of(const AnchorsRequest& request, const MeasuredPairs& measured);

/// Why there is no survey, and what to measure.
std::string sentence_of(const uwb::survey::Survey& survey, const MeasuredPairs& measured, int dimensions);

/// The question that two images put: which one is it? And what flags answer it.
std::string question_of(const uwb::survey::Survey& survey, const MeasuredPairs& measured);
std::array<Side, 2> answers_of(const uwb::survey::Survey& survey);

/// The image that was asked for; empty where nobody said which.
std::optional<uwb::survey::Image> chosen(const uwb::survey::Survey& survey, const AnchorsRequest& request);

/// Standard deviations above it are no survey.
inline constexpr double worst_sigma_m = 1.0;

/// Coordinates that these distances do not tell, and what would: empty when all are told.
std::vector<std::string> not_told(const uwb::survey::Image& image, const MeasuredPairs& measured);

std::vector<std::string> report_lines(const uwb::survey::Survey& survey, const uwb::survey::Image& image,
                                      const MeasuredPairs& measured);
nlohmann::json report_json(const uwb::survey::Image& image, const MeasuredPairs& measured);

/// Of anchors that moved.
std::vector<AnchorEdit> edits_of(const uwb::survey::Image& image, const MeasuredPairs& measured);
/// Lines of the section `site`.
std::vector<std::string> yaml_lines(const uwb::survey::Image& image, const MeasuredPairs& measured);

} // namespace locus::calibrate
