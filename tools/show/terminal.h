// The terminal at standard output, where there is one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace locus::tools {

bool on_terminal();

struct TerminalSize {
    std::size_t rows = 24;
    std::size_t columns = 80;
};

TerminalSize terminal_size();

enum class Tone { plain, good, bad, dim, strong };

/// Coloured on a terminal, unless NO_COLOR is set (no-color.org); else the text itself.
std::string toned(const std::string& text, Tone tone);

void print_lines(const std::vector<std::string>& lines);

/// Lines that are shown in place of those shown before. They stay when the program ends.
class LivePanel {
  public:
    void show(std::vector<std::string> lines);

  private:
    std::size_t shown_ = 0;
};

} // namespace locus::tools
