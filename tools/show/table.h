// A table of text with columns as wide as they need to be.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace locus::tools {

enum class Align { left, right };

struct Column {
    std::string title;
    Align align = Align::left;
    std::size_t least_width = 0; ///< so that a table that is shown again and again does not jump
};

class Table {
  public:
    explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

    /// In a row with fewer cells than columns the last one runs on over the columns that follow.
    void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    bool empty() const { return rows_.empty(); }

    /// The title line and the rows, no line ends, no space at a line's end.
    std::vector<std::string> lines() const;

  private:
    std::vector<std::size_t> widths() const;

    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// Characters of UTF-8 text, each taken as one column wide.
std::size_t width(const std::string& text);

/// The first `columns` characters.
std::string clip(const std::string& text, std::size_t columns);

} // namespace locus::tools
