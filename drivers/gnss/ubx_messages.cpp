// One walk over the fields of each message; the reader and the writer follow the same, so they cannot disagree.
#include "drivers/gnss/ubx_messages.h"

#include <concepts>
#include <type_traits>

namespace locus::gnss::ubx {
namespace {

/// T is Message, const or not: one function both reads and fills a struct.
template <class T, class Message>
concept Either = std::same_as<std::remove_const_t<T>, Message>;

struct FieldReader {
    wire::Bytes bytes;
    std::size_t at = 0;

    template <class... Fields>
    void operator()(Fields&... fields) {
        (read(fields), ...);
    }
    template <class T>
    void read(T& field) {
        field = wire::little<T>(bytes, at);
        at += sizeof(T);
    }
    template <class T, std::size_t size>
    void read(std::array<T, size>& fields) {
        for (T& field : fields) read(field);
    }
};

struct FieldWriter {
    wire::Writer writer{};

    template <class... Fields>
    void operator()(const Fields&... fields) {
        (write(fields), ...);
    }
    template <class T>
    void write(const T& field) {
        writer.little(field);
    }
    template <class T, std::size_t size>
    void write(const std::array<T, size>& fields) {
        for (const T& field : fields) write(field);
    }
};

template <class Walk, Either<NavPvt> Message>
void walk_fields(Walk& walk, Message& m) {
    walk(m.time_of_week_ms, m.year, m.month, m.day, m.hour, m.minute, m.second, m.valid, m.sigma_time_ns, m.nano_ns);
    walk(m.fix_type, m.flags, m.flags2, m.satellites, m.longitude_1e7_deg, m.latitude_1e7_deg);
    walk(m.height_ellipsoid_mm, m.height_sea_level_mm, m.sigma_horizontal_mm, m.sigma_vertical_mm);
    walk(m.velocity_ned_mmps, m.ground_speed_mmps, m.course_1e5_deg, m.sigma_speed_mmps, m.sigma_course_1e5_deg);
    walk(m.position_dilution_1e2, m.flags3, m.reserved, m.vehicle_heading_1e5_deg);
    walk(m.declination_1e2_deg, m.sigma_declination_1e2_deg);
}

template <class Walk, Either<RelativePosition> Message>
void walk_fields(Walk& walk, Message& m) {
    walk(m.version, m.reserved, m.base, m.time_of_week_ms, m.way_ned_cm, m.length_cm, m.heading_1e5_deg, m.reserved2);
    walk(m.way_rest_ned_1e4_m, m.length_rest_1e4_m, m.sigma_ned_1e4_m, m.sigma_length_1e4_m);
    walk(m.sigma_heading_1e5_deg, m.reserved3, m.flags);
}

template <class Walk, Either<RawEpoch> Message>
void walk_fields(Walk& walk, Message& m) {
    walk(m.receiver_time_s, m.gps_week, m.leap_s, m.signals, m.status, m.version, m.reserved);
}

template <class Walk, Either<RawSignal> Message>
void walk_fields(Walk& walk, Message& m) {
    walk(m.pseudorange_m, m.carrier_cycles, m.doppler_hz, m.constellation, m.satellite, m.signal, m.glonass_slot);
    walk(m.lock_ms, m.carrier_to_noise_dbhz, m.sigma_pseudorange, m.sigma_carrier, m.sigma_doppler);
    walk(m.tracking, m.reserved);
}

template <class Walk, Either<Subframe> Message>
void walk_fields(Walk& walk, Message& m) {
    walk(m.constellation, m.satellite, m.signal, m.glonass_slot, m.word_count, m.channel, m.version, m.reserved);
    for (std::size_t i = 0; i < m.word_count && i < m.words.size(); ++i) walk(m.words[i]);
}

template <class Walk, Either<SensorReport> Message>
void walk_fields(Walk& walk, Message& m) {
    walk(m.time_tag, m.flags, m.provider);
    for (std::size_t i = 0; i < m.count(); ++i) walk(m.readings[i]);
    if (m.has_receiver_time_tag()) walk(m.receiver_time_tag);
}

constexpr std::size_t pvt_length = 92;
constexpr std::size_t relative_length = 64;
constexpr std::size_t epoch_length = 16;
constexpr std::size_t signal_length = 32;
constexpr std::size_t words_begin = 8; // of a subframe, and of a sensor report

template <class Message>
Message read_at(wire::Bytes payload, std::size_t offset) {
    Message message;
    FieldReader reader{payload, offset};
    walk_fields(reader, message);
    return message;
}

template <class Message>
std::vector<std::uint8_t> framed(const Message& message) {
    FieldWriter fields;
    walk_fields(fields, message);
    return frame(Message::id, fields.writer.written());
}

} // namespace

std::optional<NavPvt> parse_nav_pvt(wire::Bytes payload) {
    if (payload.size() != pvt_length) return std::nullopt;
    return read_at<NavPvt>(payload, 0);
}

std::optional<RelativePosition> parse_relative_position(wire::Bytes payload) {
    if (payload.size() != relative_length) return std::nullopt;
    return read_at<RelativePosition>(payload, 0);
}

std::optional<RawEpoch> parse_raw_epoch(wire::Bytes payload) {
    const auto epoch = read_at<RawEpoch>(payload, 0);
    if (payload.size() != epoch_length + signal_length * epoch.signals) return std::nullopt;
    return epoch;
}

RawSignal parse_raw_signal(wire::Bytes payload, std::size_t index) {
    return read_at<RawSignal>(payload, epoch_length + signal_length * index);
}

std::optional<Subframe> parse_subframe(wire::Bytes payload) {
    const auto subframe = read_at<Subframe>(payload, 0);
    if (subframe.word_count > Subframe::max_words) return std::nullopt;
    if (payload.size() != words_begin + 4u * subframe.word_count) return std::nullopt;
    return subframe;
}

std::optional<SensorReport> parse_sensor_report(wire::Bytes payload) {
    const auto report = read_at<SensorReport>(payload, 0);
    if (payload.size() != words_begin + 4u * (report.count() + report.has_receiver_time_tag())) return std::nullopt;
    return report;
}

std::vector<std::uint8_t> encode(const NavPvt& pvt) { return framed(pvt); }
std::vector<std::uint8_t> encode(const RelativePosition& relative) { return framed(relative); }
std::vector<std::uint8_t> encode(const Subframe& subframe) { return framed(subframe); }
std::vector<std::uint8_t> encode(const SensorReport& report) { return framed(report); }

std::vector<std::uint8_t> encode(RawEpoch epoch, std::span<const RawSignal> signals) {
    epoch.signals = static_cast<std::uint8_t>(signals.size());
    FieldWriter fields;
    walk_fields(fields, epoch);
    for (const RawSignal& signal : signals.first(epoch.signals)) walk_fields(fields, signal);
    return frame(RawEpoch::id, fields.writer.written());
}

} // namespace locus::gnss::ubx
