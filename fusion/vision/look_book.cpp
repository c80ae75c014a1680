#include "fusion/vision/look_book.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace locus::vision {
namespace {

/// A look is the mean of so long: clothes stay, but light and the side that is turned to the camera do not.
constexpr double learn_s = 10;
/// Of one image, at most: cameras that look once in a minute know no more by that.
constexpr double image_s = 1;
/// Images in which usual distances are learnt.
constexpr double usual_images = 1000;
/// So many must have been in both cameras: a few coats show a few colours only.
constexpr std::size_t least_shared = 5;
/// Before anybody was in both, the gain is one; that is worth one person who wears every colour.
constexpr double unseen_share = 1.0 / std::tuple_size_v<Looks>;
/// People in uniform differ by less, and looks tell nothing.
constexpr double least_difference = 0.05;

} // namespace

LookBook::LookBook(std::size_t cameras, std::size_t max_tags)
    : cameras_(cameras), max_tags_(std::max<std::size_t>(max_tags, 1)), tags_(max_tags_),
      memories_(cameras * max_tags_), shared_(cameras * cameras), usual_(cameras) {}

std::optional<Colours> LookBook::colours(std::size_t camera, Address tag) const noexcept {
    if (const Memory* own = known(camera, tag); own != nullptr) return own->colours;
    const std::size_t here = camera;
    std::size_t best = here, tags = least_shared - 1;
    for (std::size_t other = 0; other < cameras_; ++other)
        if (shared(here, other).tags > tags && known(other, tag) != nullptr) {
            best = other;
            tags = shared(here, other).tags;
        }
    if (tags < least_shared) return std::nullopt;
    const Memory* there = known(best, tag);
    const Sum gain = (shared(here, best).sum + unseen_share) / (shared(best, here).sum + unseen_share);
    const Colours carried = (there->colours.cast<double>() * gain).cast<float>();
    return carried / carried.sum();
}

void LookBook::learn(std::size_t camera, Address tag, const Colours& seen, Timestamp time) noexcept {
    if (camera >= cameras_) return;
    const std::uint16_t number = tags_.of(tag);
    if (number == TagNumbers::none) return;
    Memory& known = memory(camera, number);
    const bool is_new = !known.is_known();
    if (!is_new && time <= known.last) return;
    if (!is_new) tell_apart(camera, number, seen);
    const double dt_s = is_new ? image_s : std::min(to_s(time - known.last), image_s);
    known.learnt_s = std::min(known.learnt_s + dt_s, learn_s);
    const Colours before = known.colours;
    known.colours += static_cast<float>(dt_s / known.learnt_s) * (seen - known.colours);
    known.last = time;
    share(camera, number, before, is_new);
}

/// Halfway between the usual distances speaks neither for nor against.
double LookBook::doubt(std::size_t camera, Address tag, const Colours& seen) const noexcept {
    if (camera >= cameras_ || usual_[camera].learnt == 0) return 0;
    const Usual& usual = usual_[camera];
    const double difference = usual.others - usual.own;
    if (difference < least_difference) return 0;
    const auto look = colours(camera, tag);
    if (!look.has_value()) return 0;
    const double halfway = (usual.own + usual.others) / 2;
    return std::clamp(2 * (bhattacharyya_distance(seen, look.value()) - halfway) / difference, -1.0, 1.0);
}

const LookBook::Memory* LookBook::known(std::size_t camera, Address tag) const noexcept {
    const auto number = tags_.find(tag);
    if (camera >= cameras_ || number == TagNumbers::none) return nullptr;
    const Memory& found = memory(camera, number);
    return found.is_known() ? &found : nullptr;
}

void LookBook::tell_apart(std::size_t camera, std::size_t tag, const Colours& seen) noexcept {
    double sum = 0;
    int others = 0;
    for (std::size_t other = 0; other < tags_.size(); ++other)
        if (other != tag && memory(camera, other).is_known()) {
            sum += bhattacharyya_distance(seen, memory(camera, other).colours);
            ++others;
        }
    if (others == 0) return;
    Usual& usual = usual_[camera];
    usual.learnt = std::min(usual.learnt + 1, usual_images);
    usual.own += (bhattacharyya_distance(seen, memory(camera, tag).colours) - usual.own) / usual.learnt;
    usual.others += (sum / others - usual.others) / usual.learnt;
}

/// Each tag counts once however long it was seen, so the sums follow its look.
void LookBook::share(std::size_t camera, std::size_t tag, const Colours& before, bool is_new) noexcept {
    const std::size_t here = camera;
    const Colours& now = memory(here, tag).colours;
    for (std::size_t other = 0; other < cameras_; ++other) {
        const Memory& there = memory(other, tag);
        if (other == here || !there.is_known()) continue;
        shared(here, other).sum += now.cast<double>();
        if (!is_new) shared(here, other).sum -= before.cast<double>();
        if (!is_new) continue;
        shared(other, here).sum += there.colours.cast<double>();
        ++shared(here, other).tags;
        ++shared(other, here).tags;
    }
}

} // namespace locus::vision
