#include "drivers/gnss/rinex_header.h"

namespace locus::gnss::rinex {

void Header::read(std::string_view line, std::string& error) {
    const std::string_view what = label(line);
    if (what == "SYS / # / OBS TYPES") return read_types(line, error);
    if (what == "GLONASS SLOT / FRQ #") return read_slots(line, error);
    if (what == "TIME OF FIRST OBS") return read_time_system(line, error);
    if (what == "SYS / SCALE FACTOR") error = "values that are multiplied (SYS / SCALE FACTOR) are not read";
    if (what == "END OF HEADER") ended_ = true;
}

/// "G   10 C1C L1C ...", 13 in a line; the next lines have no letter.
void Header::read_types(std::string_view line, std::string& error) {
    if (line[0] != ' ') {
        continued_ = constellation_of(line[0]);
        if (continued_) types_[*continued_].clear();
    }
    if (!continued_) return; // a constellation that is not known here
    auto& types = types_[*continued_];
    for (std::size_t at = 7; at + 3 <= 58; at += 4) {
        const std::string_view type = columns(line, at, 3);
        if (type.empty()) break;
        if (type.size() != 3 || types.size() == most_types) {
            error = "the list of observation types cannot be read";
            return;
        }
        types.emplace_back(type);
    }
}

/// " 24 R01  1 R02 -4 ...", 8 in a line.
void Header::read_slots(std::string_view line, std::string& error) {
    for (std::size_t at = 4; at + 6 <= 60; at += 7) {
        if (columns(line, at, 7).empty()) continue;
        const auto which = satellite(columns(line, at, 3));
        const auto frequency = whole(columns(line, at + 4, 2));
        const bool good =
            which && which->constellation == constellation::glonass && frequency && *frequency >= -7 && *frequency <= 6;
        if (good)
            slots_[which->number] = static_cast<std::uint8_t>(*frequency + 7);
        else
            error = "the table of GLONASS frequencies cannot be read";
    }
}

void Header::read_time_system(std::string_view line, std::string& error) {
    const std::string_view system = columns(line, 48, 3);
    if (system == "GLO")
        count_ = Count::utc;
    else if (system == "BDT")
        count_ = Count::beidou;
    else if (system.empty() || system == "GPS" || system == "GAL" || system == "QZS")
        count_ = Count::gps;
    else
        error = "the time system '" + std::string(system) + "' is not known";
}

std::optional<std::uint8_t> Header::glonass_slot(std::uint8_t satellite) const {
    const auto found = slots_.find(satellite);
    return found == slots_.end() ? std::nullopt : std::optional{found->second};
}

std::optional<GpsTime> Header::time(const CivilTime& date) const {
    if (count_ == Count::utc) return gps_time_of_utc(date);
    const auto time = gps_time(date);
    return time && count_ == Count::beidou ? std::optional{*time + gps_minus_beidou_s} : time;
}

} // namespace locus::gnss::rinex
