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

// In the order of the file, and within a place in the order they were found.
void Problems::insert(Mark mark, std::string message) {
    const auto place = [](const ConfigProblem& problem) { return std::tie(problem.line, problem.column); };
    ConfigProblem problem{file_, mark.line, mark.column, std::move(message)};
    problems_.insert(std::ranges::upper_bound(problems_, place(problem), {}, place), std::move(problem));
}

void Problems::add(Mark mark, std::string message) {
    if (problems_.size() < max_problems)
        insert(mark, std::move(message));
    else if (problems_.size() == max_problems)
        insert(mark, "there are more problems; these come first");
}

std::vector<ConfigProblem> Problems::take() { return std::move(problems_); }

} // namespace config
} // namespace locus
