#include "drivers/gnss/nmea_sentence.h"

#include "drivers/wire/checksum.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace locus::gnss::nmea {
namespace {

template <class Number>
bool read_number(std::string_view text, Number& number, int base = 10) {
    std::from_chars_result result{};
    if constexpr (std::is_floating_point_v<Number>)
        result = std::from_chars(text.begin(), text.end(), number, std::chars_format::fixed);
    else
        result = std::from_chars(text.begin(), text.end(), number, base);
    return result.ec == std::errc{} && result.ptr == text.end();
}

/// Address without its talker: two letters of a talker and three of a type, or P and the maker's own.
std::string_view type_of(std::string_view address) {
    return address.size() == 5 && address[0] != 'P' ? address.substr(2) : std::string_view{};
}

bool split(std::string_view body, Sentence& sentence) {
    for (std::size_t begin = 0; begin <= body.size();) {
        if (sentence.count == Sentence::max_fields) return false;
        const std::size_t end = std::min(body.find(',', begin), body.size());
        sentence.fields[sentence.count++] = body.substr(begin, end - begin);
        begin = end + 1;
    }
    sentence.type = type_of(sentence.fields[0]);
    return true;
}

} // namespace

std::variant<Sentence, Refusal> parse_sentence(std::string_view line, bool need_checksum) {
    const std::size_t dollar = line.rfind('$');
    if (dollar == std::string_view::npos) return Refusal::garbage;
    std::string_view body = line.substr(dollar + 1);
    if (const std::size_t star = body.find('*'); star != std::string_view::npos) {
        std::uint8_t told = 0;
        if (body.size() != star + 3 || !read_number(body.substr(star + 1), told, 16)) return Refusal::malformed;
        body = body.substr(0, star);
        if (wire::xor8(body) != told) return Refusal::bad_checksum;
    } else if (need_checksum) {
        return Refusal::bad_checksum;
    }
    Sentence sentence;
    if (!split(body, sentence)) return Refusal::malformed;
    return sentence;
}

double Fields::number(std::size_t i) {
    double value = not_told;
    if (text(i).empty()) return value;
    return read_number(text(i), value) && std::isfinite(value) ? value : fail();
}

unsigned Fields::whole(std::size_t i, unsigned most) {
    unsigned value = 0;
    if (!text(i).empty() && (!read_number(text(i), value) || value > most)) fail();
    return value;
}

char Fields::letter(std::size_t i) {
    if (text(i).size() > 1) fail();
    return text(i).empty() ? '\0' : text(i)[0];
}

std::int64_t Fields::time_of_day_us(std::size_t i) {
    if (text(i).empty()) return no_time;
    unsigned clock = 0;
    double second = 0;
    const bool read = text(i).size() >= 6 && read_number(text(i).substr(0, 4), clock) &&
                      read_number(text(i).substr(4), second) && second >= 0 && second < 61;
    if (!read || clock / 100 > 23 || clock % 100 > 59) return fail(), no_time;
    return (clock / 100 * 3600 + clock % 100 * 60) * std::int64_t{1'000'000} + std::llround(second * 1e6);
}

double Fields::angle_deg(std::size_t i, char positive, char negative, double limit_deg) {
    const std::string_view angle = text(i);
    const char side = letter(i + 1);
    if (angle.empty() && side == '\0') return not_told;
    const std::size_t point = std::min(angle.find('.'), angle.size());
    unsigned degrees = 0;
    double minutes = 0;
    const bool read = point > 2 && read_number(angle.substr(0, point - 2), degrees) &&
                      read_number(angle.substr(point - 2), minutes) && minutes >= 0 && minutes < 60;
    const double value = degrees + minutes / 60;
    if (!read || value > limit_deg || (side != positive && side != negative)) return fail();
    return side == positive ? value : -value;
}

std::string framed(std::string_view body) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    const std::uint8_t sum = wire::xor8(body);
    return std::string{"$"}.append(body).append({'*', digits[sum >> 4], digits[sum & 15], '\r', '\n'});
}

} // namespace locus::gnss::nmea
