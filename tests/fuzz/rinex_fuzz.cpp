// RINEX of strangers: whatever stands in it, measurements are possible ones, and words decode to what was printed.
#include "drivers/gnss/rinex_navigation.h"
#include "drivers/gnss/rinex_observations.h"
#include "fusion/gnss/ephemeris_words.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace locus;
using namespace locus::gnss;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

struct Sink : MeasurementSink {
    void accept(Timestamp time, const Observation& observation) override {
        const auto& raw = std::get<GnssRaw>(observation);
        require(to_ns(time) >= 0 && raw.pseudorange_m > 0 && std::isfinite(raw.pseudorange_m));
        require(std::isfinite(raw.carrier_cycles) && std::isfinite(raw.doppler_hz) && !std::isnan(raw.lock_s));
        require(raw.satellite > 0 && raw.signal <= 10 && raw.glonass_slot <= 13);
        require(raw.receiver_time_s_in_gps_week >= 0 && raw.receiver_time_s_in_gps_week < week_s);
    }
    void refuse(Refusal) override {}
};

void check(const rinex::NavigationRecord& record) {
    static EphemerisCollector collector;
    const auto words = encode(record.ephemeris, record.sent, record.leap_s);
    std::optional<Ephemeris> decoded;
    for (const auto& one : words) {
        require(one.word_count > 0 && one.word_count <= GnssNavigation::max_words);
        decoded = collector.add(one, record.sent);
    }
    if (decoded) require(decoded->index() == record.ephemeris.index());
}

template <class OnLine>
void each_line(std::string_view text, const OnLine& on_line) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        on_line(line);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text{reinterpret_cast<const char*>(data), size};
    rinex::Observations observations{address(0)};
    rinex::Navigation navigation;
    Sink sink;
    each_line(text, [&](std::string_view line) {
        std::string error;
        observations.read(line, sink, error);
        error.clear();
        if (const auto record = navigation.read(line, error)) check(*record);
    });
    std::string error;
    observations.finish(error);
    error.clear();
    if (const auto record = navigation.finish(error)) check(*record);
    return 0;
}
