#include "drivers/gnss/rinex_navigation.h"

#include "drivers/gnss/rinex_record.h"

#include <fmt/format.h>

#include <utility>

namespace locus::gnss::rinex {
namespace {

constexpr std::size_t number_width = 19;

} // namespace

std::optional<NavigationRecord> Navigation::read(std::string_view line, std::string& error) {
    if (line.size() > longest_line) error = "it is longer than any line of RINEX";
    if (columns(line, 0, line.size()).empty() || !error.empty()) return std::nullopt;
    if (!header_ended_) {
        read_header(line, error);
        return std::nullopt;
    }
    if (columns(line, 0, shift() - 1).empty()) {
        read_values(line, shift(), error);
        return std::nullopt;
    }
    auto record = finish(error);
    if (!error.empty()) error = "the record before it, of " + error;
    begin_record(line, error);
    return record;
}

void Navigation::read_header(std::string_view line, std::string& error) {
    if (!std::exchange(begun_, true)) {
        const auto kind = kind_of(line);
        if (!kind) error = "it is not the first line of a RINEX file";
        kind_ = kind.value_or(Kind{});
        // Version 2 has a file for each constellation, and version 3.0x may.
        system_ = kind_.type == 'G' ? 'R' : 'G';
    }
    read_ionosphere(line, error);
    header_ended_ = label(line) == "END OF HEADER";
}

/// Version 2 "  .1118D-07 ..." with a label of its own for alpha and beta, version 3 "GPSA   .1118E-07 ...".
void Navigation::read_ionosphere(std::string_view line, std::string& error) {
    constexpr std::size_t width = 12;
    const std::string_view name = label(line), which = columns(line, 0, 4);
    const bool version3 = name == "IONOSPHERIC CORR";
    const bool alpha = name == "ION ALPHA" || (version3 && which == "GPSA");
    const bool beta = name == "ION BETA" || (version3 && which == "GPSB");
    if (!alpha && !beta) return;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto value = real(columns(line, (version3 ? 5 : 2) + i * width, width));
        if (!value) error = fmt::format("coefficient {} of the ionosphere is no number", i + 1);
        if (!value) return;
        (alpha ? ionosphere_.alpha : ionosphere_.beta)[i] = *value;
    }
    (alpha ? has_alpha_ : has_beta_) = true;
}

std::optional<Klobuchar> Navigation::ionosphere() const {
    return has_alpha_ && has_beta_ ? std::optional(ionosphere_) : std::nullopt;
}

/// "G05 2019 04 27 20 00 00", in version 2 " 5 19  4 27 20  0  0.0".
void Navigation::begin_record(std::string_view line, std::string& error) {
    open_ = true;
    values_.clear();
    head_ = line.substr(0, shift() + number_width);
    read_values(line, shift() + number_width, error);
}

void Navigation::read_values(std::string_view line, std::size_t begin, std::string& error) {
    for (std::size_t at = begin; at < begin + (begin > number_width ? 3 : 4) * number_width; at += number_width) {
        const std::string_view text = columns(line, at, number_width);
        const auto value = text.empty() ? std::nullopt : real(text);
        if (!text.empty() && !value) error = fmt::format("'{}' in column {} is no number", text, at + 1);
        if (values_.size() < most_values) values_.push_back(value);
    }
}

std::optional<NavigationRecord> Navigation::finish(std::string& error) {
    if (!header_ended_) error = "the file ends inside its header";
    if (!std::exchange(open_, false) || !error.empty()) return std::nullopt;
    const bool version2 = kind_.version < 3;
    const std::string name = version2 ? fmt::format("{}{:>2}", system_, columns(head_, 0, 2)) : head_.substr(0, 3);
    const auto which = satellite(name);
    const auto reference = date(columns(head_, version2 ? 2 : 3, number_width + 1));
    std::string wrong;
    if (!which && name[0] != 'I') wrong = "there is no such satellite";
    if (!reference) wrong = "its time is no date";
    auto record = which && reference && wrong.empty() ? record_of(*which, *reference, values_, wrong) : std::nullopt;
    if (!wrong.empty()) error = fmt::format("{}: {}", name, wrong);
    if (!record && wrong.empty()) ++passed_over_;
    return record;
}

} // namespace locus::gnss::rinex
