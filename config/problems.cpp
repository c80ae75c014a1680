#include "config/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace locus {

std::string to_string(const ConfigProblem& problem) {
    if (problem.line == 0) return fmt::format("{}: {}", problem.file, problem.message);
    return fmt::format("{}:{}:{}: {}", problem.file, problem.line, problem.column, problem.message);
}

namespace config {

void Problems::add(Mark mark, std::string message) {
    if (problems_.size() < max_problems)
        problems_.push_back({file_, mark.line, mark.column, std::move(message)});
    else if (problems_.size() == max_problems)
        problems_.push_back({file_, mark.line, mark.column, "there are more problems; these come first"});
}

std::vector<ConfigProblem> Problems::take() {
    std::stable_sort(problems_.begin(), problems_.end(), [](const ConfigProblem& a, const ConfigProblem& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
    return std::move(problems_);
}

} // namespace config
} // namespace locus
