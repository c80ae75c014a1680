// NMEA logs: sentences tell the time of day in UTC, RMC and ZDA the date, the table of leap seconds the rest.
#include "drivers/gnss/gps_timestamp.h"
#include "drivers/gnss/nmea.h"
#include "drivers/gnss/nmea_messages.h"
#include "fusion/gnss/calendar.h"
#include "tools/import/lines.h"
#include "tools/import/source.h"

#include <cmath>

namespace locus::importing {
namespace {

using namespace gnss::nmea;
using gnss::GpsTime;

constexpr double day_s = 86400;

/// What one sentence says of the time.
struct TimeTold {
    std::int64_t of_day_us = no_time;
    std::optional<gnss::CivilTime> date; ///< midnight
};

template <class Message>
TimeTold time_in(const std::optional<Message>& message) {
    TimeTold told;
    if (!message) return told;
    told.of_day_us = message->time_us;
    if constexpr (requires { message->date_ddmmyy; }) {
        const auto date = static_cast<int>(message->date_ddmmyy);
        if (date != 0) told.date = {2000 + date % 100, date / 100 % 100, date / 10000};
    }
    if constexpr (requires { message->year; })
        if (message->year != 0)
            told.date = {static_cast<int>(message->year), static_cast<int>(message->month),
                         static_cast<int>(message->day)};
    return told;
}

TimeTold time_told(std::string_view line) {
    const auto parsed = parse_sentence(line, true);
    const auto* sentence = std::get_if<Sentence>(&parsed);
    if (!sentence) return {};
    if (sentence->type == "RMC") return time_in(parse_rmc(*sentence));
    if (sentence->type == "ZDA") return time_in(parse_zda(*sentence));
    if (sentence->type == "GGA") return time_in(parse_gga(*sentence));
    if (sentence->type == "GST") return time_in(parse_gst(*sentence));
    return {};
}

/// Sentences' times in GPS time: a date holds for the times around it.
class Calendar {
  public:
    /// Empty before the first date.
    std::optional<GpsTime> time_of(const TimeTold& told) {
        const double of_day_s = static_cast<double>(told.of_day_us) * 1e-6;
        if (told.date) {
            leap_s_ = gnss::leap_seconds(*told.date);
            if (const auto midnight = gnss::gps_time(*told.date)) last_ = *midnight + (of_day_s + leap_s_);
        } else if (last_) {
            last_ = *last_ + std::remainder(of_day_s + leap_s_ - last_->second, day_s);
        }
        return last_;
    }

  private:
    int leap_s_ = 0;
    std::optional<GpsTime> last_;
};

class NmeaSource final : public Source {
  public:
    NmeaSource(const std::string& path, Address tag) : lines_{path}, settings_{tag} {
        settings_.use_receiver_time = false;
        decoder_ = gnss::make_nmea(&settings_);
        find_date(path);
    }

    bool read(std::vector<Item>& items) override {
        std::string_view line;
        if (!lines_.next(line)) return finish(items);
        const TimeTold told = time_told(line);
        if (told.of_day_us != no_time) now_ = calendar_.time_of(told);
        decode(line, items);
        return true;
    }

  private:
    Lines lines_;
    gnss::NmeaSettings settings_;
    std::unique_ptr<Decoder> decoder_;
    Calendar calendar_;
    std::optional<GpsTime> now_;

    /// Sentences may come before the first that has a date.
    void find_date(const std::string& path) {
        Lines lines{path};
        for (std::string_view line; !now_ && lines.next(line);) {
            const TimeTold told = time_told(line);
            if (told.of_day_us != no_time && told.date) now_ = calendar_.time_of(told);
        }
        if (!now_) report_.problem("no sentence (RMC or ZDA) tells the date, so nothing of it can be dated");
    }

    void decode(std::string_view line, std::vector<Item>& items) {
        if (!now_) return;
        ListSink sink{items, report_};
        const std::string text = std::string(line) + '\n';
        Packet packet;
        packet.time = gnss::timestamp(*now_);
        packet.data = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
        decoder_->decode(packet, sink);
    }

    /// The decoder gives a moment's fix when the next begins: one second later, by a sentence that holds nothing else.
    bool finish(std::vector<Item>& items) {
        if (!now_) return false;
        Gga end;
        end.time_us = std::llround(std::fmod(now_->second + 1, day_s) * 1e6);
        const std::string sentence = encode(end);
        decode(std::string_view(sentence).substr(0, sentence.size() - 2), items);
        now_.reset();
        return false;
    }
};

} // namespace

std::unique_ptr<Source> open_nmea_log(const std::string& path, Address tag) {
    return std::make_unique<NmeaSource>(path, tag);
}

} // namespace locus::importing
