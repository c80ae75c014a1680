#include "fusion/target_table.h"

#include "fusion/vision/anonymous.h"

#include <charconv>
#include <stdexcept>

namespace locus {
namespace {

/// Enough that a roll-back runs over a seventh of the window more than it must, at most.
constexpr std::size_t snapshots_per_target = 9;
constexpr std::string_view longest_address = "0xffffffffffffffff", longest_name = "anonymous-65536-65536";

TimelineLimits limits_of(const FusionSettings& fusion) {
    TimelineLimits limits;
    limits.snapshots = snapshots_per_target;
    limits.snapshot_spacing = duration_from_s(fusion.window_s / (snapshots_per_target - 2));
    limits.lost_after = duration_from_s(fusion.lost_after_s);
    // A measurement stays for the window, the way back to the snapshot before it, and a tick on either side.
    const double longest_stay_s = fusion.window_s + to_s(limits.snapshot_spacing) + 2 / fusion.rate_hz;
    limits.measurements = 16 + static_cast<std::size_t>(longest_stay_s * fusion.max_measurement_rate_hz);
    return limits;
}

std::uint16_t row_number(const EstimatorRow* row) { return static_cast<std::uint16_t>(row - estimator_table().data()); }

/// Within the capacity that the string has already.
void write_name(std::string& text, Address address) noexcept {
    if (vision::is_anonymous(address)) return vision::write_anonymous_name(text, address);
    text = longest_address;
    const auto end = std::to_chars(text.data() + 2, text.data() + text.size(), number(address), 16).ptr;
    text.resize(static_cast<std::size_t>(end - text.data()));
}

} // namespace

TargetTable::TargetTable(const EngineSettings& settings, FreshEstimators& fresh)
    : slots_(static_cast<std::size_t>(settings.fusion.max_targets)),
      accepts_strangers_(settings.fusion.accept_unknown_targets) {
    const auto room = static_cast<std::size_t>(settings.fusion.max_targets);
    if (settings.targets.size() > room)
        throw std::invalid_argument("there are " + std::to_string(settings.targets.size()) +
                                    " targets, but max_targets is " + std::to_string(room));
    const TimelineLimits limits = limits_of(settings.fusion);
    targets_.reserve(room);
    for (const TargetSettings& target : settings.targets) {
        if (slots_.find(target.address) != none)
            throw std::invalid_argument("two targets have the address of \"" + target.name + "\"");
        slots_.put(target.address, static_cast<Slot>(targets_.size()));
        add(target, fresh.of(target.estimator.empty() ? settings.fusion.estimator : target.estimator), limits);
    }
    used_ = targets_.size();
    const bool anonymous = settings.cameras > 0 && settings.vision.anonymous;
    const TargetSettings stranger{std::string(longest_name), no_address, {}};
    while ((accepts_strangers_ || anonymous) && targets_.size() < room)
        add(stranger, fresh.of(settings.fusion.estimator), limits);
}

void TargetTable::add(const TargetSettings& settings, const FreshEstimators::Item& fresh,
                      const TimelineLimits& limits) {
    targets_.push_back({settings.name, settings.address, row_number(fresh.row), {*fresh.estimator, limits}});
}

TargetTable::Slot TargetTable::slot_of(Address tag) noexcept {
    const Slot slot = slots_.find(tag);
    const bool may_open = tag != no_address && (accepts_strangers_ || vision::is_anonymous(tag));
    return slot == none && may_open ? open(tag) : slot;
}

TargetTable::Slot TargetTable::open(Address tag) noexcept {
    if (used_ == targets_.size()) return none;
    const auto slot = static_cast<Slot>(used_++);
    slots_.put(tag, slot);
    targets_[slot].address = tag;
    write_name(targets_[slot].name, tag);
    return slot;
}

Pose TargetTable::blank_pose(Slot slot) const noexcept {
    Pose pose;
    pose.target = targets_[slot].address;
    pose.target_index = slot;
    pose.estimator = targets_[slot].estimator;
    return pose;
}

} // namespace locus
