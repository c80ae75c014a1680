#include "drivers/gnss/nmea_messages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace locus::gnss::nmea {
namespace {

constexpr double quarter_deg = 90;
constexpr double half_deg = 180;
constexpr unsigned most_satellites = 255;

template <class Message>
std::optional<Message> if_good(const Fields& fields, const Message& message) {
    return fields.good() ? std::optional{message} : std::nullopt;
}

/// Fields one after the other, each with its comma.
class Body {
  public:
    explicit Body(std::string_view address) : text_{address} {}

    Body& text(std::string_view field) { return text_.append(",").append(field), *this; }
    template <class... Values>
    Body& print(const char* format, Values... values) {
        std::array<char, 400> buffer; // a double of 1e308 printed in full
        std::snprintf(buffer.data(), buffer.size(), format, values...);
        return text(buffer.data());
    }
    Body& number(double value) { return std::isnan(value) ? text("") : print("%.3f", value); }
    Body& whole(unsigned value) { return print("%u", value); }
    Body& time(std::int64_t us) {
        if (us == no_time) return text("");
        constexpr std::int64_t last_minute = 24 * 60 - 1;
        const auto seconds = us / 1'000'000, minutes = std::min(seconds / 60, last_minute); // 23:59:60
        return print("%02d%02d%02d.%06d", static_cast<int>(minutes / 60), static_cast<int>(minutes % 60),
                     static_cast<int>(seconds - 60 * minutes), static_cast<int>(us % 1'000'000));
    }
    Body& angle(double angle_deg, int width, std::string_view positive, std::string_view negative) {
        if (std::isnan(angle_deg)) return text("").text("");
        const long long parts = std::llround(std::abs(angle_deg) * 60e7); // 1e-7 minutes
        const long long degrees = parts / 600'000'000, minutes = parts % 600'000'000;
        print("%0*lld%02lld.%07lld", width, degrees, minutes / 10'000'000, minutes % 10'000'000);
        return text(angle_deg < 0 ? negative : positive);
    }
    std::string line() const { return framed(text_); }

  private:
    std::string text_;
};

} // namespace

std::optional<Gga> parse_gga(const Sentence& sentence) {
    Fields fields{sentence};
    Gga gga;
    gga.time_us = fields.time_of_day_us(1);
    gga.latitude_deg = fields.angle_deg(2, 'N', 'S', quarter_deg);
    gga.longitude_deg = fields.angle_deg(4, 'E', 'W', half_deg);
    gga.quality = fields.whole(6, 9);
    gga.satellites = fields.whole(7, most_satellites);
    gga.horizontal_dilution = fields.number(8);
    gga.altitude_sea_level_m = fields.number(9);
    gga.geoid_separation_m = fields.number(11);
    return if_good(fields, gga);
}

std::optional<Rmc> parse_rmc(const Sentence& sentence) {
    Fields fields{sentence};
    Rmc rmc;
    rmc.time_us = fields.time_of_day_us(1);
    rmc.valid = fields.letter(2) == 'A';
    rmc.latitude_deg = fields.angle_deg(3, 'N', 'S', quarter_deg);
    rmc.longitude_deg = fields.angle_deg(5, 'E', 'W', half_deg);
    rmc.speed_knots = fields.number(7);
    rmc.course_deg = fields.number(8);
    rmc.date_ddmmyy = fields.whole(9, 311299);
    if (fields.text(12).size() == 1) rmc.mode = fields.text(12)[0];
    return if_good(fields, rmc);
}

std::optional<Vtg> parse_vtg(const Sentence& sentence) {
    Fields fields{sentence};
    Vtg vtg;
    vtg.course_deg = fields.number(1);
    vtg.speed_knots = fields.number(5);
    vtg.mode = fields.letter(9);
    return if_good(fields, vtg);
}

std::optional<Gst> parse_gst(const Sentence& sentence) {
    Fields fields{sentence};
    Gst gst;
    gst.time_us = fields.time_of_day_us(1);
    gst.sigma_latitude_m = fields.number(6);
    gst.sigma_longitude_m = fields.number(7);
    gst.sigma_altitude_m = fields.number(8);
    return if_good(fields, gst);
}

std::optional<Zda> parse_zda(const Sentence& sentence) {
    Fields fields{sentence};
    Zda zda;
    zda.time_us = fields.time_of_day_us(1);
    zda.day = fields.whole(2, 31);
    zda.month = fields.whole(3, 12);
    zda.year = fields.whole(4, 9999);
    return if_good(fields, zda);
}

std::optional<Hdt> parse_hdt(const Sentence& sentence) {
    Fields fields{sentence};
    const Hdt hdt{fields.number(1)};
    return if_good(fields, hdt);
}

std::optional<Ths> parse_ths(const Sentence& sentence) {
    Fields fields{sentence};
    Ths ths;
    ths.heading_deg = fields.number(1);
    ths.mode = fields.letter(2);
    return if_good(fields, ths);
}

std::string encode(const Gga& gga) {
    Body body{"GNGGA"};
    body.time(gga.time_us).angle(gga.latitude_deg, 2, "N", "S").angle(gga.longitude_deg, 3, "E", "W");
    body.whole(gga.quality).whole(gga.satellites).number(gga.horizontal_dilution);
    body.number(gga.altitude_sea_level_m).text("M").number(gga.geoid_separation_m).text("M").text("").text("");
    return body.line();
}

std::string encode(const Rmc& rmc) {
    Body body{"GNRMC"};
    body.time(rmc.time_us).text(rmc.valid ? "A" : "V");
    body.angle(rmc.latitude_deg, 2, "N", "S").angle(rmc.longitude_deg, 3, "E", "W");
    body.number(rmc.speed_knots).number(rmc.course_deg).print("%06u", rmc.date_ddmmyy);
    const char mode = rmc.mode != 0 ? rmc.mode : rmc.valid ? 'A' : 'N';
    return body.text("").text("").text({&mode, 1}).line();
}

std::string encode(const Vtg& vtg) {
    constexpr double kmh_per_knot = 1.852;
    Body body{"GNVTG"};
    body.number(vtg.course_deg).text("T").text("").text("M").number(vtg.speed_knots).text("N");
    body.number(vtg.speed_knots * kmh_per_knot).text("K");
    return body.text({&vtg.mode, vtg.mode == 0 ? 0u : 1u}).line();
}

std::string encode(const Gst& gst) {
    Body body{"GNGST"};
    body.time(gst.time_us).text("").text("").text("").text("");
    return body.number(gst.sigma_latitude_m).number(gst.sigma_longitude_m).number(gst.sigma_altitude_m).line();
}

std::string encode(const Zda& zda) {
    Body body{"GNZDA"};
    body.time(zda.time_us).print("%02u", zda.day).print("%02u", zda.month).print("%04u", zda.year);
    return body.text("00").text("00").line();
}

std::string encode(const Hdt& hdt) { return Body{"GNHDT"}.number(hdt.heading_deg).text("T").line(); }
std::string encode(const Ths& ths) {
    return Body{"GNTHS"}.number(ths.heading_deg).text({&ths.mode, ths.mode == 0 ? 0u : 1u}).line();
}

} // namespace locus::gnss::nmea
