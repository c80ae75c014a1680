#include "tools/show/table.h"

#include <algorithm>

namespace locus::tools {

namespace {

bool starts_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }

std::string padded(const std::string& text, std::size_t columns, Align align) {
    const std::string space(columns - std::min(columns, width(text)), ' ');
    return align == Align::left ? text + space : space + text;
}

bool runs_on(const std::vector<std::string>& cells, std::size_t i, std::size_t columns) {
    return i + 1 == cells.size() && cells.size() < columns;
}

std::string line(const std::vector<std::string>& cells, const std::vector<Column>& columns,
                 const std::vector<std::size_t>& widths) {
    std::string result;
    for (std::size_t i = 0; i < std::min(cells.size(), columns.size()); ++i) {
        if (i > 0) result += "  ";
        result += runs_on(cells, i, columns.size()) ? cells[i] : padded(cells[i], widths[i], columns[i].align);
    }
    result.erase(result.find_last_not_of(' ') + 1);
    return result;
}

} // namespace

std::size_t width(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, starts_character));
}

std::string clip(const std::string& text, std::size_t columns) {
    std::size_t end = 0;
    for (std::size_t seen = 0; end < text.size(); ++end)
        if (starts_character(text[end]) && ++seen > columns) break;
    return text.substr(0, end);
}

std::vector<std::size_t> Table::widths() const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        result.push_back(std::max(columns_[i].least_width, width(columns_[i].title)));
        for (const auto& row : rows_)
            if (i < row.size() && !runs_on(row, i, columns_.size())) result[i] = std::max(result[i], width(row[i]));
    }
    return result;
}

std::vector<std::string> Table::lines() const {
    std::vector<std::string> titles;
    for (const auto& column : columns_) titles.push_back(column.title);
    const auto wide = widths();
    std::vector<std::string> result{line(titles, columns_, wide)};
    for (const auto& row : rows_) result.push_back(line(row, columns_, wide));
    return result;
}

} // namespace locus::tools
