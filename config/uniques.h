// Finds the second one of something that must be there once.
#pragma once

#include "config/problems.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

namespace locus::config {

class Uniques {
  public:
    /// `what` as in "a second anchor with the name A0".
    /// `why` follows the value: ", which ...".
    explicit Uniques(std::string what, std::string why = "") : what_(std::move(what)), why_(std::move(why)) {}

    void check(const std::string& value, Mark mark, Problems& problems) {
        const auto [first, is_new] = first_lines_.try_emplace(value, mark.line);
        if (!is_new)
            problems.add(mark,
                         fmt::format("a second {} {}{}; the first is in line {}", what_, value, why_, first->second));
    }

  private:
    std::string what_;
    std::string why_;
    std::map<std::string, int> first_lines_;
};

} // namespace locus::config
