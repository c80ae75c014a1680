#include "fusion/aid_book.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// Rates are counted over blocks of this length, each block weighing as much as all before it.
constexpr Duration rate_block = duration_from_s(1);
constexpr float newest_block_weight = 0.5f;
constexpr float newest_delay_weight = 1.0f / 16;
/// A stamp further off than this is a wrong stamp, not a delay.
constexpr double longest_delay_s = 60;

void smooth_delay(AidStatus& status, Timestamp time, Timestamp arrival) {
    const double delay_s = to_s(arrival) - to_s(time);
    if (std::abs(delay_s) > longest_delay_s) return;
    const float weight = status.counters.received == 1 ? 1 : newest_delay_weight;
    status.delay_s += weight * (static_cast<float>(delay_s) - status.delay_s);
}

/// `step` is 1 or, to take back, the 1 that is subtracted: unsigned numbers wrap as wanted.
template <class Counters>
void add(Counters& counters, Exclusion reason, std::uint64_t step) {
    if (reason == Exclusion::none)
        counters.used += step;
    else if (reason == Exclusion::late)
        counters.late += step;
    else
        counters.refused += step;
}

/// What a satellite says of its orbit is counted, but it is no observation: its status tells of its ranges.
void write_down(AidStatus& status, const Measurement& measurement, const Verdict& verdict) {
    if (std::holds_alternative<GnssNavigation>(measurement.observation)) return;
    const bool first = status.last_verdict.reason == Exclusion::not_seen_yet;
    const bool stamp_is_wrong = verdict.reason == Exclusion::stamp_in_future;
    if (!first && !stamp_is_wrong && measurement.time < status.last_time) return;
    status.last_verdict = verdict;
    status.last_observation = is_finite(measurement.observation) ? shown_value(measurement.observation) : 0;
    if (!stamp_is_wrong) status.last_time = measurement.time;
}

} // namespace

AidBook::AidBook(const Site& site) : index_(site.anchors.size() + room_for_others) {
    sources_.reserve(site.anchors.size() + room_for_others);
    heard_in_block_.reserve(sources_.capacity());
    for (const Anchor& anchor : site.anchors) source_index({SourceKind::anchor, anchor.address});
}

std::uint16_t AidBook::source_index(Key key) noexcept {
    const auto found = index_.find(key);
    if (found != no_source) return found;
    const auto next = static_cast<std::uint16_t>(sources_.size());
    if (!index_.put(key, next)) return no_source;
    open(key);
    return next;
}

void AidBook::open(Key key) noexcept {
    AidStatus status;
    status.kind = key.first;
    status.source = key.second;
    sources_.push_back(status);
    heard_in_block_.push_back(0);
}

AidBook::Record AidBook::hear(const Measurement& measurement, const Delivery& delivery, Timestamp arrival) noexcept {
    ++total_.received;
    Record record;
    for (std::size_t i = 0; i < delivery.source_count; ++i) {
        const auto index = source_index({delivery.kind, delivery.sources[i]});
        record.sources[i] = index;
        if (index == no_source) continue;
        AidStatus& status = sources_[index];
        ++status.counters.received;
        ++heard_in_block_[index];
        status.input = measurement.input;
        status.last_target = delivery.tag.value_or(no_address);
        smooth_delay(status, measurement.time, arrival);
    }
    return record;
}

void AidBook::judge(const Measurement& measurement, Record& record, const Verdict& verdict) noexcept {
    if (record.counted != Exclusion::count_) count(record, std::uint64_t{0} - 1);
    record.counted = verdict.reason;
    count(record, 1);
    for (const auto index : record.sources) {
        if (index == no_source) continue;
        AidStatus& status = sources_[index];
        write_down(status, measurement, verdict);
        if (verdict.reason == Exclusion::none)
            status.last_used_time = std::max(status.last_used_time, measurement.time);
    }
}

void AidBook::count(const Record& record, std::uint64_t step) noexcept {
    add(total_, record.counted, step);
    total_.by_reason[static_cast<std::size_t>(record.counted)] += step;
    for (const auto index : record.sources)
        if (index != no_source) add(sources_[index].counters, record.counted, step);
}

void AidBook::update_rates(Timestamp tick) noexcept {
    if (!block_start_) block_start_ = tick;
    if (tick < *block_start_ + rate_block) return;
    const auto block_s = static_cast<float>(to_s(tick - *block_start_));
    block_start_ = tick;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const float rate_hz = static_cast<float>(std::exchange(heard_in_block_[i], 0)) / block_s;
        const float weight = sources_[i].rate_hz == 0 ? 1 : newest_block_weight;
        sources_[i].rate_hz += weight * (rate_hz - sources_[i].rate_hz);
    }
}

} // namespace locus
