#include "fusion/vision/identity.h"

#include "fusion/vision/assignment.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::vision {
namespace {

/// Squared Mahalanobis distance, and what is lacking in proof where the ellipse is wider than usual: ln det S / det S0.
double distance2(const SeenPerson& person, const LocatedTag& tag, double usual_sigma_m) {
    const Eigen::Matrix2d spread = person.covariance_m2 + tag.covariance_m2;
    const Eigen::Vector2d way_m = person.position_site_m - tag.position_site_m;
    const double wider = std::log(spread.determinant()) - 4 * std::log(usual_sigma_m);
    return way_m.dot(spread.inverse() * way_m) + std::max(wider, 0.0);
}

} // namespace

std::span<const Named> Identity::update(Timestamp time, std::span<const SeenPerson> people,
                                        std::span<const LocatedTag> tags) {
    for (const SeenPerson& person : people)
        for (const LocatedTag& tag : tags) weigh(time, person, tag);
    forget(time);
    assign_tags(people);
    named_.clear();
    for (const SeenPerson& person : people) {
        Named named{person.track, std::nullopt, 0};
        if (const auto held = held_.find(person.track); held != held_.end())
            named = {person.track, held->second, confidence(person.track, held->second)};
        named_.push_back(named);
    }
    return named_;
}

/// A running mean whose memory is the window; it begins as a plain mean. No single distance counts for more than twice
/// the gate, so that one outlier parts nobody.
void Identity::weigh(Timestamp time, const SeenPerson& person, const LocatedTag& tag) {
    const double distance = std::min(distance2(person, tag, settings_.sigma_m), 2 * settings_.gate);
    if (!std::isfinite(distance)) return;
    const auto [place, is_new] = evidence_.try_emplace({person.track, tag.tag});
    Evidence& evidence = place->second;
    if (!is_new && time <= evidence.last) return;
    const double dt_s = is_new ? 0 : std::min(to_s(time - evidence.last), settings_.window_s);
    evidence.weighed_s += dt_s;
    const double plain_share = is_new ? 1 : dt_s / (evidence.weighed_s + dt_s);
    evidence.mean += std::max(plain_share, 1 - std::exp(-dt_s / settings_.window_s)) * (distance - evidence.mean);
    evidence.last = time;
}

void Identity::forget(Timestamp time) {
    std::erase_if(evidence_, [&](const auto& entry) { return to_s(time - entry.second.last) > settings_.forget_s; });
    std::erase_if(held_, [&](const auto& entry) { return !evidence_.contains(entry); });
}

/// Of people in the image with all tags that there is evidence of; a tag whose track is out of sight may go to another.
void Identity::assign_tags(std::span<const SeenPerson> people) {
    std::vector<Address> tags;
    for (const auto& [pair, evidence] : evidence_) tags.push_back(pair.second);
    std::sort(tags.begin(), tags.end());
    tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
    Costs costs(people.size(), tags.size());
    for (std::size_t i = 0; i < people.size(); ++i)
        for (std::size_t j = 0; j < tags.size(); ++j) {
            const auto held = held_.find(people[i].track);
            const bool is_held = held != held_.end() && held->second == tags[j];
            costs.at(i, j) = cost(people[i].track, tags[j]) - (is_held ? settings_.loyalty : 0);
        }
    for (const SeenPerson& person : people) held_.erase(person.track);
    for (const auto& [i, j] : assign(costs, settings_.gate)) {
        const Address tag = tags[j];
        std::erase_if(held_, [&](const auto& entry) { return entry.second == tag; });
        held_[people[i].track] = tag;
    }
}

double Identity::cost(std::uint32_t track, Address tag) const {
    const auto found = evidence_.find({track, tag});
    const bool is_settled = found != evidence_.end() && found->second.weighed_s >= settings_.settle_s;
    return is_settled ? found->second.mean : std::numeric_limits<double>::infinity();
}

double Identity::confidence(std::uint32_t track, Address tag) const {
    const auto likelihood = [&](double distance) { return std::exp(-0.5 * distance); };
    const double this_one = likelihood(cost(track, tag));
    double all = likelihood(settings_.gate) + this_one;
    for (const auto& [pair, evidence] : evidence_)
        if ((pair.first == track) != (pair.second == tag)) all += likelihood(cost(pair.first, pair.second));
    return this_one / all;
}

} // namespace locus::vision
