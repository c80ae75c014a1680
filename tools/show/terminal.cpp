#include "tools/show/terminal.h"

#include "tools/show/table.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace locus::tools {

namespace {

std::string_view escape(Tone tone) {
    switch (tone) {
    case Tone::good:
        return "\x1b[32m";
    case Tone::bad:
        return "\x1b[31m";
    case Tone::dim:
        return "\x1b[2m";
    case Tone::strong:
        return "\x1b[1m";
    case Tone::plain:
        break;
    }
    return {};
}

bool colours_wanted() {
    const char* no_color = std::getenv("NO_COLOR");
    return on_terminal() && (!no_color || !*no_color);
}

} // namespace

bool on_terminal() { return ::isatty(STDOUT_FILENO) == 1; }

TerminalSize terminal_size() {
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0 || size.ws_col == 0) return {};
    return {size.ws_row, size.ws_col};
}

std::string toned(const std::string& text, Tone tone) {
    if (tone == Tone::plain || !colours_wanted()) return text;
    return fmt::format("{}{}\x1b[0m", escape(tone), text);
}

void print_lines(const std::vector<std::string>& lines) {
    for (const auto& line : lines) fmt::print("{}\n", line);
}

// One write for all of it, so that a refresh does not flicker. A line may not wrap, nor the panel scroll: the cursor
// could not find back.
void LivePanel::show(std::vector<std::string> lines) {
    const TerminalSize size = terminal_size();
    if (lines.size() >= size.rows) {
        lines.resize(size.rows - 1);
        lines.back() = "... the terminal is too small for all of it";
    }
    std::string out = shown_ ? fmt::format("\x1b[{}F", shown_) : "\r";
    for (const auto& line : lines) out += clip(line, size.columns) + "\x1b[K\n";
    fmt::print("{}\x1b[J", out);
    std::fflush(stdout);
    shown_ = lines.size();
}

} // namespace locus::tools
