#include "drivers/uwb/pulson/radio.h"

#include "drivers/uwb/pulson/lengths.h"

#include <algorithm>

namespace locus::uwb::pulson {
namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t farthest_mm = 10'000'000; // ten times what the strongest of these radios reaches
/// A neighbour's range of that age says nothing of now; also what a first database is searched for.
constexpr milliseconds oldest{1000};

LineOfSight sight(std::uint16_t edges) {
    if (edges & no_line_of_sight) return LineOfSight::blocked;
    return edges & line_of_sight ? LineOfSight::clear : LineOfSight::unknown;
}

/// One end in the shade spoils the range; clear it is only when both say so.
LineOfSight sight(std::uint16_t requester_edge, std::uint16_t responder_edge) {
    const LineOfSight one = sight(requester_edge), other = sight(responder_edge);
    if (one == LineOfSight::blocked || other == LineOfSight::blocked) return LineOfSight::blocked;
    return one == other ? one : LineOfSight::unknown;
}

void give_range(Address anchor, Address tag, std::uint64_t range_mm, std::uint32_t sigma_mm, LineOfSight line_of_sight,
                Timestamp time, MeasurementSink& sink) {
    if (range_mm > farthest_mm) return sink.refuse(Refusal::out_of_range);
    Range range;
    range.anchor = anchor;
    range.tag = tag;
    range.range_m = static_cast<double>(range_mm) * 1e-3;
    if (sigma_mm > 0) range.sigma_m = static_cast<float>(sigma_mm) * 1e-3f;
    range.line_of_sight = line_of_sight;
    sink.accept(time, range);
}

} // namespace

Radio::Radio(const PulsonSettings& settings)
    : settings_{settings}, requests_{settings.responders, duration_from_s(settings.request_timeout_s)} {}

void Radio::message(wire::Bytes bytes, Timestamp time, MeasurementSink& sink) {
    requests_.heard(time);
    const auto type = wire::big<std::uint16_t>(bytes, 0);
    switch (type) {
    case 0x0201:
        return read<FullRange>(bytes, time, sink);
    case 0x0204:
        return read<EchoedRange>(bytes, time, sink);
    case 0x0205:
    case 0x3201:
        return read<SmallRange>(bytes, time, sink);
    case 0x3105:
    case 0x3203:
        return read<FullNeighbors>(bytes, time, sink);
    case 0x3106:
    case 0x3204:
        return read<SmallNeighbors>(bytes, time, sink);
    default:
        break;
    }
    const auto rule = length_rule(type);
    if (!rule) return sink.refuse(Refusal::unknown_type);
    rule->allows(bytes) ? sink.frame(bytes) : sink.refuse(Refusal::malformed);
}

void Radio::reset() {
    requests_.reset();
    last_small_database_.reset();
    last_full_database_ms_.reset();
}

template <class Message>
void Radio::read(wire::Bytes bytes, Timestamp time, MeasurementSink& sink) {
    const auto message = parse<Message>(bytes);
    if (!message) return sink.refuse(Refusal::malformed);
    sink.frame(bytes);
    use(*message, time, sink);
}

/// A coarse update of an overheard packet carries its status as a success carries 0.
bool Radio::takes(std::uint8_t status, std::uint8_t parts, Part wanted) const {
    if (!(parts & wanted)) return false;
    return wanted == precise ? status == success
                             : settings_.use_coarse && (status == success || status == coarse_update);
}

void Radio::use(const FullRange& range, Timestamp time, MeasurementSink& sink) {
    if (range.status != coarse_update) requests_.answered(range.message);
    last_range_ = time;
    const LineOfSight line_of_sight = sight(range.requester_edge, range.responder_edge);
    if (takes(range.status, range.parts, precise))
        give(range.responder, {range.precise_mm, range.precise_sigma_mm, line_of_sight}, time, sink);
    else if (takes(range.status, range.parts, coarse))
        give(range.responder, {range.coarse_mm, range.coarse_sigma_mm, line_of_sight}, time, sink);
}

void Radio::use(const SmallRange& range, Timestamp time, MeasurementSink& sink) {
    if (range.status != coarse_update) requests_.answered(range.message);
    last_range_ = time;
    if (takes(range.status, range.parts, precise) || takes(range.status, range.parts, coarse))
        give(range.responder, {range.range_cm * 10u, range.sigma_cm * 10u}, time, sink);
}

/// Of two other radios: who asks is the tag, whatever this one is.
void Radio::use(const EchoedRange& range, Timestamp time, MeasurementSink& sink) {
    if (heard_before({range.requester, range.timestamp})) return;
    give_range(address(range.responder), address(range.requester), range.precise_mm, range.precise_sigma_mm,
               sight(range.edges), time, sink);
}

/// New is what was measured since the database before this one, by the radio's own clock.
void Radio::use(const FullNeighbors& database, Timestamp time, MeasurementSink& sink) {
    const milliseconds since{database.timestamp_ms - last_full_database_ms_.value_or(database.timestamp_ms - 1000)};
    last_full_database_ms_ = database.timestamp_ms;
    if (ranges_come_by_themselves(time)) return;
    for (std::size_t i = 0; i < database.count; ++i) {
        const FullNeighbor& one = database.neighbors[i];
        const milliseconds age{database.timestamp_ms - one.ranged_ms};
        if (age >= std::min(since, oldest)) continue;
        if (takes(one.status, one.parts, precise) || takes(one.status, one.parts, coarse))
            give(one.node, {one.range_mm, one.sigma_mm, sight(one.edges)}, time - age, sink);
    }
}

/// The same by the time of arrival: a small database does not say its own.
void Radio::use(const SmallNeighbors& database, Timestamp time, MeasurementSink& sink) {
    const Duration since = last_small_database_ ? time - *last_small_database_ : Duration{oldest};
    last_small_database_ = time;
    if (ranges_come_by_themselves(time)) return;
    for (std::size_t i = 0; i < database.count; ++i) {
        const SmallNeighbor& one = database.neighbors[i];
        const milliseconds age{one.age_ms};
        if (age >= std::min<Duration>(since, oldest)) continue;
        if (takes(success, one.parts, precise) || takes(success, one.parts, coarse))
            give(one.node, {one.range_cm * 10u, one.sigma_cm * 10u}, time - age, sink);
    }
}

/// The range stays in the requests of its owner until he has a newer one.
bool Radio::heard_before(const Echo& echo) {
    if (std::ranges::find(echoes_, echo) != echoes_.end()) return true;
    echoes_[next_echo_] = echo;
    next_echo_ = (next_echo_ + 1) % echoes_.size();
    return false;
}

/// A radio may be set to send every range and its database too: then the database says all of it a second time.
bool Radio::ranges_come_by_themselves(Timestamp time) const { return last_range_ && time - *last_range_ < oldest; }

void Radio::give(std::uint32_t other, const Said& said, Timestamp time, MeasurementSink& sink) const {
    const Address there = address(other), here = settings_.tag;
    give_range(settings_.radio_is_anchor ? here : there, settings_.radio_is_anchor ? there : here, said.range_mm,
               said.sigma_mm, said.line_of_sight, time, sink);
}

} // namespace locus::uwb::pulson
