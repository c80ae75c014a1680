#include "fusion/vision/foot_points.h"

#include <algorithm>

namespace locus::vision {
namespace {

SeenPerson as_seen(const FootPoint& foot) {
    const auto [xx, xy, yy] = foot.covariance_m2;
    return {foot.track,
            {foot.position_site_m[0], foot.position_site_m[1]},
            Eigen::Matrix2d{{xx, xy}, {xy, yy}},
            foot.looks};
}

bool reads_looks(const VisionSettings& settings) {
    return settings.looks_weight > 0 || settings.association == "matrix";
}

std::unique_ptr<Naming> naming_of(const VisionSettings& settings, std::size_t max_tags, CameraLooks looks) {
    if (settings.association == "matrix") return std::make_unique<AssociationMatrix>(settings, max_tags, looks);
    return std::make_unique<Identity>(settings, max_tags, looks);
}

} // namespace

FootPoints::Image::Image(const VisionSettings& settings, std::size_t max_tags, CameraLooks looks, Duration rest)
    : naming(naming_of(settings, max_tags, looks)), strangers(static_cast<std::size_t>(settings.max_anonymous), rest) {
    feet.reserve(max_people);
}

FootPoints::FootPoints(const VisionSettings& settings, std::size_t cameras, std::size_t max_tags, Duration longest_wait,
                       Duration rest)
    : settings_(settings), gather_(std::min(duration_from_s(settings.gather_s), longest_wait)),
      looks_(std::make_unique<LookBook>(reads_looks(settings) ? cameras : 0, max_tags)) {
    images_.reserve(cameras);
    while (images_.size() < cameras)
        images_.emplace_back(settings, max_tags, CameraLooks(*looks_, images_.size()), rest);
    people_.reserve(max_people);
}

Exclusion FootPoints::hear(const Measurement& measurement, const AidBook::Record& record, Timestamp arrival,
                           Output& output) noexcept {
    const HeardFoot heard{measurement, record};
    const auto camera = number(heard.foot().camera);
    if (camera >= images_.size()) return Exclusion::unknown_camera;
    Image& image = images_[camera];
    if (measurement.time < image.time || (measurement.time == image.time && image.feet.empty())) return Exclusion::late;
    if (measurement.time != image.time) deal(image, output);
    if (image.feet.size() == max_people) return Exclusion::window_full;
    if (image.feet.empty()) image.first_arrival = arrival;
    image.time = measurement.time;
    image.feet.push_back(heard);
    return Exclusion::none;
}

void FootPoints::run(Timestamp tick, Output& output) noexcept {
    for (Image& image : images_)
        if (tick - image.first_arrival >= gather_) deal(image, output);
}

void FootPoints::deal(Image& image, Output& output) noexcept {
    if (image.feet.empty()) return;
    people_.clear();
    for (const HeardFoot& heard : image.feet) people_.push_back(as_seen(heard.foot()));
    const auto named = image.naming->update(image.time, people_, output.locate(image.time));
    for (std::size_t i = 0; i < image.feet.size(); ++i) hand_on(image, image.feet[i], named[i], output);
    image.feet.clear();
}

void FootPoints::hand_on(Image& image, const HeardFoot& heard, const Named& named, Output& output) const noexcept {
    const auto give = [&](const FeetOwner& owner) { output.give(heard.measurement, heard.record, owner); };
    if (named.tag.has_value() && named.confidence >= settings_.least_confidence)
        return give({named.tag.value(), named.confidence});
    const bool may_be_a_target = settings_.anonymous && !named.tag.has_value();
    const auto stranger =
        may_be_a_target ? image.strangers.target_of(heard.foot().camera, heard.foot().track, image.time) : std::nullopt;
    if (stranger.has_value()) return give({stranger.value(), 0});
    output.judge(heard.measurement, heard.record, Exclusion::nobody_known);
}

} // namespace locus::vision
