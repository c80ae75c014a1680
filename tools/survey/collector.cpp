#include "tools/survey/collector.h"

#include <algorithm>
#include <utility>

namespace locus::survey {
namespace {

/// Between poses farther apart nobody knows which way was taken.
constexpr double longest_gap_s = 1;

} // namespace

std::optional<Vec3> place_at(const evaluate::Track& track, double time_s) {
    const auto after = std::ranges::upper_bound(track, time_s, {}, &evaluate::TrackPoint::time_s);
    if (after == track.begin() || after == track.end()) return std::nullopt;
    const auto before = after - 1;
    const double gap_s = after->time_s - before->time_s;
    if (gap_s > longest_gap_s) return std::nullopt;
    const Eigen::Vector3d place =
        before->position_m + (time_s - before->time_s) / gap_s * (after->position_m - before->position_m);
    return Vec3{place.x(), place.y(), place.z()};
}

void Collector::add(const radio::Reading& reading, double time_s, const evaluate::Track& track) {
    const auto place = stood_site_m_.has_value() ? stood_site_m_ : place_at(track, time_s);
    if (!place.has_value()) {
        ++collected_.unplaced;
        return;
    }
    survey_.add(reading, place.value());
    ++collected_.readings;
}

Collected Collector::finish(const Heading& heading) {
    collected_.map = survey_.map();
    collected_.map.site = heading.site;
    collected_.map.date = heading.date;
    collected_.map.device = heading.device;
    return std::move(collected_);
}

} // namespace locus::survey
