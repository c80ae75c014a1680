// TREK1000 lines: grammar in trek1000.h.
#include "drivers/uwb/trek1000.h"

#include "drivers/line_splitter.h"
#include "drivers/wire/bytes.h"

#include <algorithm>
#include <charconv>

namespace locus::uwb {
namespace {

constexpr std::size_t head_tokens = 2; // kind, mask
constexpr std::size_t tail_tokens = 4; // long count, sequence, debug, role
constexpr std::size_t max_tokens = head_tokens + TrekReport::max_ranges + tail_tokens;
constexpr double farthest_m = 20e3; // as the firmware itself has it

struct Tokens {
    std::array<std::string_view, max_tokens> at;
    std::size_t count = 0; ///< max_tokens + 1: there were more
};

Tokens split(std::string_view line) {
    Tokens tokens;
    for (std::size_t begin = 0; begin < line.size();) {
        const std::size_t end = std::min(line.find(' ', begin), line.size());
        if (end > begin) {
            if (tokens.count == max_tokens) return ++tokens.count, tokens;
            tokens.at[tokens.count++] = line.substr(begin, end - begin);
        }
        begin = end + 1;
    }
    return tokens;
}

template <class Number>
bool read(std::string_view text, int base, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
    return error == std::errc{} && end == text.data() + text.size();
}

bool read_range(std::string_view text, std::int32_t& range_mm) {
    std::uint32_t bits = 0;
    if (text.size() != 8 || !read(text, 16, bits)) return false;
    range_mm = static_cast<std::int32_t>(bits);
    return true;
}

/// "a0:3": printed by an anchor, tag 0, anchor 3.
bool read_role(std::string_view text, TrekReport& report) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos || (text[0] != 'a' && text[0] != 't')) return false;
    report.role = text[0];
    return read(text.substr(1, colon - 1), 10, report.tag) && read(text.substr(colon + 1), 10, report.anchor);
}

bool is_kind(std::string_view token, char kind) { return token.size() == 2 && token[0] == 'm' && token[1] == kind; }

class Trek1000 : public Decoder {
  public:
    explicit Trek1000(const TrekSettings& settings) : settings_(settings) {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        lines_.feed(
            packet, [&](std::string_view text, Timestamp complete) { line(text, complete, sink); },
            [&] { sink.refuse(Refusal::too_long); });
    }

    void reset() override { lines_.reset(); }

  private:
    TrekSettings settings_;
    LineSplitter lines_;

    /// No field but the first holds an 'm': whatever stands before the last one is the rest of a damaged line.
    void line(std::string_view text, Timestamp complete, MeasurementSink& sink) const {
        const std::size_t begin = text.rfind('m');
        if (begin == std::string_view::npos)
            return sink.refuse(text[0] == '$' ? Refusal::unknown_type : Refusal::garbage);
        if (begin > 0) sink.refuse(Refusal::garbage);
        report(text.substr(begin), complete, sink);
    }

    void report(std::string_view text, Timestamp complete, MeasurementSink& sink) const {
        const std::string_view kind = text.substr(0, text.find(' '));
        if (is_kind(kind, 'e')) return sink.frame(wire::bytes_of(text)); // event counters of a debug build
        if (!is_kind(kind, 'c') && !is_kind(kind, 'r') && !is_kind(kind, 'a'))
            return sink.refuse(kind.size() == 2 ? Refusal::unknown_type : Refusal::garbage);
        const auto report = parse_trek_report(text);
        if (!report) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        if (report->kind == 'c') ranges(*report, complete, sink);
    }

    void ranges(const TrekReport& report, Timestamp complete, MeasurementSink& sink) const {
        for (unsigned i = 0; i < report.columns; ++i) {
            if (!(report.mask >> i & 1)) continue;
            const double range_m = report.range_mm[i] * 1e-3;
            if (range_m < 0 || range_m > farthest_m) {
                sink.refuse(Refusal::out_of_range);
                continue;
            }
            Range range;
            range.anchor = address(i + static_cast<unsigned>(settings_.anchor_offset));
            range.tag = address(report.tag + static_cast<unsigned>(settings_.tag_offset));
            range.range_m = range_m;
            sink.accept(complete, range);
        }
    }
};

void append_hex(std::string& text, std::uint32_t value, std::size_t width) {
    std::array<char, 8> digits;
    const char* const end = std::to_chars(digits.begin(), digits.end(), value, 16).ptr;
    const auto count = static_cast<std::size_t>(end - digits.begin());
    text += ' ';
    text.append(width > count ? width - count : 0, '0').append(digits.begin(), count);
}

} // namespace

std::string encode(const TrekReport& report) {
    std::string line{'m', report.kind};
    append_hex(line, report.mask, 2);
    for (unsigned i = 0; i < report.columns; ++i) append_hex(line, static_cast<std::uint32_t>(report.range_mm[i]), 8);
    append_hex(line, report.long_count, 4);
    append_hex(line, report.sequence, 2);
    append_hex(line, report.debug, 8);
    line.append({' ', report.role}).append(std::to_string(report.tag)).append(":");
    return line.append(std::to_string(report.anchor)).append("\r\n");
}

std::optional<TrekReport> parse_trek_report(std::string_view line) {
    const Tokens tokens = split(line);
    if (tokens.count <= head_tokens + tail_tokens || tokens.count > max_tokens) return std::nullopt;
    if (tokens.at[0].size() != 2) return std::nullopt;
    TrekReport report;
    report.kind = tokens.at[0][1];
    report.columns = static_cast<std::uint8_t>(tokens.count - head_tokens - tail_tokens);
    for (std::size_t i = 0; i < report.columns; ++i)
        if (!read_range(tokens.at[head_tokens + i], report.range_mm[i])) return std::nullopt;
    const auto* const tail = &tokens.at[head_tokens + report.columns];
    const bool good = read(tokens.at[1], 16, report.mask) && read(tail[0], 16, report.long_count) &&
                      read(tail[1], 16, report.sequence) && read(tail[2], 16, report.debug) &&
                      read_role(tail[3], report);
    if (!good || report.mask >> report.columns != 0) return std::nullopt;
    return report;
}

std::unique_ptr<Decoder> make_trek1000(const void* settings) {
    return std::make_unique<Trek1000>(*static_cast<const TrekSettings*>(settings));
}

} // namespace locus::uwb
