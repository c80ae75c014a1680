#include "drivers/recording/log_line.h"

#include "drivers/recording/can_text.h"
#include "drivers/recording/hex.h"
#include "drivers/recording/stamp.h"

#include <algorithm>
#include <charconv>

namespace locus {
namespace {

constexpr std::string_view serial_mark = "serial#";
constexpr std::string_view blank = " \t\r\n";
constexpr std::size_t max_serial_bytes = 4096;

std::string stamp_text(Timestamp time) {
    std::string text = "(";
    append_seconds(text, time);
    text.resize(text.size() - 3); // nanoseconds: see log_line.h
    return text + ") ";
}

/// The next word, taken off the front of `rest`.
std::string_view take_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blank), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(blank));
    rest.remove_prefix(word.size());
    return word;
}

bool parse_stamp(std::string_view word, Timestamp& time, std::string& error) {
    const bool bracketed = word.size() > 2 && word.front() == '(' && word.back() == ')';
    const auto parsed = bracketed ? parse_seconds(word.substr(1, word.size() - 2)) : std::nullopt;
    time = parsed.value_or(time);
    if (!parsed || word[1] == '-') error = "it does not begin with a time such as (1700000000.123456)";
    return error.empty();
}

bool parse_frame(std::string_view word, LogRecord& record, std::string& error) {
    if (!word.starts_with(serial_mark)) return parse_can_text(word, record, error);
    return parse_hex_bytes(word.substr(serial_mark.size()), max_serial_bytes, record.data, error);
}

bool parse_byte_time(std::string_view word, Duration& byte_time) {
    std::uint32_t ns = 0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), ns);
    byte_time = Duration{ns};
    return failed == std::errc{} && end == word.data() + word.size();
}

/// candump -x ends its lines in T or R (sent or received), a serial line may end in the time of a byte.
bool parse_suffix(std::string_view rest, LogRecord& record, std::string& error) {
    const std::string_view word = take_word(rest);
    const bool known = word.empty() || (record.wire == Wire::can ? word == "T" || word == "R"
                                                                 : parse_byte_time(word, record.byte_time));
    if (!known || !take_word(rest).empty()) error = "there is something after the data";
    return error.empty();
}

} // namespace

std::string to_log_line(const std::string& input, const Packet& packet) {
    std::string text = stamp_text(packet.time) + input + ' ';
    if (packet.wire == Wire::can) {
        append_can_text(text, packet);
    } else {
        text += serial_mark;
        append_hex(text, packet.data);
        if (packet.byte_time > Duration::zero()) text += ' ' + std::to_string(packet.byte_time.count());
    }
    return text;
}

std::optional<LogRecord> from_log_line(std::string_view line, std::string& error) {
    error.clear();
    if (line.find_first_not_of(blank) == std::string_view::npos || line.starts_with('#')) return std::nullopt;
    LogRecord record;
    if (!parse_stamp(take_word(line), record.time, error)) return std::nullopt;
    record.input = take_word(line);
    if (!parse_frame(take_word(line), record, error) || !parse_suffix(line, record, error)) return std::nullopt;
    return record;
}

} // namespace locus
