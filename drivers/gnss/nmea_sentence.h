// One NMEA 0183 sentence (protocols.md 5.2): its frame, and its fields by number. Receivers of different years send
// different numbers of fields, so a field that is not there is the same as one that is empty.
#pragma once

#include "drivers/decoder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace locus::gnss::nmea {

/// What an empty field says.
inline constexpr double not_told = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int64_t no_time = -1;

struct Sentence {
    static constexpr std::size_t max_fields = 32;

    std::string_view type; ///< GGA, RMC ...; empty for proprietary sentences ($P...)
    std::array<std::string_view, max_fields> fields{};
    std::size_t count = 0; ///< field 0 is the address
};

/// Reads a line without its end; what stands before the last '$' is the rest of a damaged line. The views are into it.
/// A checksum that is there must be right; one that is not there is refused if it is needed.
std::variant<Sentence, Refusal> parse_sentence(std::string_view line, bool need_checksum);

/// Takes fields out of a sentence; what cannot be read leaves good() false.
class Fields {
  public:
    explicit Fields(const Sentence& sentence) : sentence_{sentence} {}

    bool good() const { return good_; }
    std::string_view text(std::size_t i) const {
        return i < sentence_.count ? sentence_.fields[i] : std::string_view{};
    }
    double number(std::size_t i);
    /// A whole number up to `most`; 0 when empty.
    unsigned whole(std::size_t i, unsigned most);
    /// One letter; 0 when empty.
    char letter(std::size_t i);
    /// Microseconds since midnight from hhmmss.sss; no_time when empty.
    std::int64_t time_of_day_us(std::size_t i);
    /// Degrees from ddmm.mmmm in field i and a letter in the next, `negative` for south or west.
    double angle_deg(std::size_t i, char positive, char negative, double limit_deg);

  private:
    double fail() { return good_ = false, not_told; }

    const Sentence& sentence_;
    bool good_ = true;
};

/// "$" body "*" checksum "\r\n"; the body begins with the address: "GPGGA,...".
std::string framed(std::string_view body);

} // namespace locus::gnss::nmea
