// Collects what is wrong with a file while the loader goes on reading, so that all of it is told in one go.
#pragma once

#include "config/load.h"

#include <string>
#include <utility>
#include <vector>

namespace locus::config {

/// A place in a file, both from 1; {0, 0}: the file as a whole.
struct Mark {
    int line = 0;
    int column = 0;
};

class Problems {
  public:
    explicit Problems(std::string file) : file_(std::move(file)) {}

    /// Beyond max_problems nothing is kept: a file that is wrong everywhere is told so and no more.
    void add(Mark mark, std::string message);

    bool empty() const { return problems_.empty(); }
    std::size_t size() const { return problems_.size(); }

    /// In the order of the file.
    std::vector<ConfigProblem> take();

    static constexpr std::size_t max_problems = 100;

  private:
    void insert(Mark mark, std::string message);

    std::string file_;
    std::vector<ConfigProblem> problems_;
};

} // namespace locus::config
