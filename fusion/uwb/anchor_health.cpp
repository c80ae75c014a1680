#include "fusion/uwb/anchor_health.h"

#include "fusion/filter/gate.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

constexpr double step_s = 1;
/// One anchor explains an error plainly better than another at odds above 20 to 1: 2 ln 20.
constexpr double plainly = 6;
/// To be named it takes more, for it is asked again and again: 2 ln 3000.
constexpr double beyond_doubt = 16;
/// Independent looks before an anchor is called good, and before it is called wrong.
constexpr double looks_to_know = 5, looks_to_name = 15;
constexpr double blocked_memory_s = 10, naming_memory_s = 15;
constexpr double mostly = 0.5;
/// A bad path is well again when its error is below this share of the least, so that states do not flicker.
constexpr double well_share = 0.5;
/// Chi-square per look beyond which a displacement does not explain what is seen.
constexpr double most_misfit = 2;
/// Coordinates less certain than this are not told.
constexpr double most_sigma_m = 0.5;

double test(const AnchorError& error) {
    return error.information > 0 ? error.pull * error.pull / error.information : 0;
}
double estimate_m(const AnchorError& error) { return error.information > 0 ? error.pull / error.information : 0; }

bool stands_out(double most, double next) { return most - next >= beyond_doubt; }

/// From enough sides.
bool is_seen(const AnchorEvidence::Shift& shift) { return shift.covariance_m2.trace() < most_sigma_m * most_sigma_m; }

bool is_plane(const EpochPrior& prior) { return prior.position_sigma_m.z() == 0; }

} // namespace

AnchorHealth::AnchorHealth(const Site& site, const AnchorHealthSettings& settings, std::size_t targets)
    : site_(site), settings_(settings), limit_(std::pow(filter::gate_in_sigma(settings.false_alarm), 2)),
      records_(site.anchors.size()), paths_(targets * site.anchors.size()) {
    in_epoch_.reserve(site.anchors.size());
}

AnchorHealth::Path& AnchorHealth::path(Target target, std::int16_t anchor) noexcept {
    return paths_[target * records_.size() + static_cast<std::size_t>(anchor)];
}
const AnchorHealth::Path& AnchorHealth::path(Target target, std::int16_t anchor) const noexcept {
    return paths_[target * records_.size() + static_cast<std::size_t>(anchor)];
}

bool AnchorHealth::in_doubt(Target target, std::int16_t anchor) const noexcept {
    return records_[static_cast<std::size_t>(anchor)].named || path(target, anchor).bad;
}

std::size_t AnchorHealth::doubts_of(Target target, Anchors& doubts) const noexcept {
    std::size_t count = 0;
    for (const bool wants_named : {true, false})
        for (const std::int16_t anchor : in_epoch_)
            if (count < doubts.size() && in_doubt(target, anchor) &&
                records_[static_cast<std::size_t>(anchor)].named == wants_named)
                doubts[count++] = anchor;
    return count;
}

void AnchorHealth::collect_anchors(std::span<const SightLine> lines) noexcept {
    in_epoch_.clear();
    for (const SightLine& line : lines)
        for (const std::int16_t anchor : {line.sighting.plus, line.sighting.minus})
            if (anchor != Sighting::nobody && std::ranges::find(in_epoch_, anchor) == in_epoch_.end())
                in_epoch_.push_back(anchor);
}

/// Anchors beyond what the unknowns take. With one to spare it is seen that something is wrong, with two what.
/// Range differences are blind to what all arrivals share, and so are ranges until it has been learnt.
int AnchorHealth::spare(const Epoch& epoch, std::size_t doubts) const noexcept {
    const int axes = is_plane(epoch.prior) ? 2 : 3;
    const bool ranges =
        std::ranges::any_of(epoch.lines, [](const SightLine& line) { return line.sighting.is_range(); });
    const bool shared = !ranges || epoch.prior.common_sigma_m > settings_.held_error_sigma_m;
    return static_cast<int>(in_epoch_.size()) - axes - (shared ? 1 : 0) - static_cast<int>(doubts);
}

std::optional<AnchorHealth::Common> AnchorHealth::take(const Epoch& epoch) noexcept {
    if ((std::size_t{epoch.target} + 1) * records_.size() > paths_.size()) return {};
    collect_anchors(epoch.lines);
    Anchors doubts{};
    const std::size_t doubt_count = doubts_of(epoch.target, doubts);
    const int to_spare = spare(epoch, doubt_count);
    if (to_spare < 0) return {};
    const LeaveOneOut leave_one_out(site_, epoch.lines, epoch.prior, {doubts.data(), doubt_count});
    for (const std::int16_t anchor : in_epoch_)
        if (to_spare >= 2 || in_doubt(epoch.target, anchor)) look(epoch, anchor, leave_one_out, to_spare >= 2);
    judge_paths(epoch);
    return Common{leave_one_out.common_m(), leave_one_out.common_variance_m2()};
}

void AnchorHealth::remember(Path& path, const AnchorError& error, const Epoch& epoch) const noexcept {
    const bool first = path.time == Timestamp::min();
    const double keep = first ? 0 : std::exp(-std::max(0.0, to_s(epoch.time - path.time)) / settings_.path_memory_s);
    path.time = epoch.time;
    path.error.pull = keep * path.error.pull + epoch.weight * error.pull;
    path.error.information = keep * path.error.information + epoch.weight * error.information;
}

void AnchorHealth::look(const Epoch& epoch, std::int16_t anchor, const LeaveOneOut& leave_one_out,
                        bool checked) noexcept {
    const AnchorError error = leave_one_out.error_of(anchor);
    const Eigen::Vector3d tag_site_m = epoch.lines.back().tag_site_m;
    Record& r = record(anchor);
    Path& seen = path(epoch.target, anchor);
    remember(seen, error, epoch);
    r.looks += epoch.weight;
    if (seen.bad && estimate_m(seen.error) > 0) r.blocked_looks += epoch.weight;

    const Eigen::Vector3d stands_m = anchor_site_m(site_, anchor);
    const Sight by_settings = sight_of(tag_site_m, stands_m);
    // Where the others cannot check each other, their own errors are easily taken for a place.
    const Eigen::Vector3d side = checked ? by_settings.gradient : Eigen::Vector3d::Zero().eval();
    r.evidence.add(error, side, epoch.weight);
    r.recent.add(error, side, epoch.weight);
    if (!r.offset_m || !checked) return;
    const Sight by_offset = sight_of(tag_site_m, stands_m + *r.offset_m);
    const double explained_m = by_offset.range_m - by_settings.range_m;
    r.elsewhere.add({error.pull - explained_m * error.information, error.information}, by_offset.gradient,
                    epoch.weight);
}

void AnchorHealth::judge_paths(const Epoch& epoch) noexcept {
    Path* worst = nullptr;
    double most = 0, next = 0;
    for (const std::int16_t anchor : in_epoch_) {
        Path& one = path(epoch.target, anchor);
        const bool slight = std::abs(estimate_m(one.error)) < settings_.least_error_m;
        if (one.bad && std::abs(estimate_m(one.error)) < well_share * settings_.least_error_m) one.bad = false;
        if (in_doubt(epoch.target, anchor)) continue;
        const double its = test(one.error);
        next = std::max(next, std::min(most, its));
        if (its <= most) continue;
        most = its;
        worst = slight ? nullptr : &one;
    }
    if (worst == nullptr || most < limit_ || !stands_out(most, next)) return;
    for (const std::int16_t anchor :
         in_epoch_) // what was thought of the others was thought with the bad one among them
        if (Path& other = path(epoch.target, anchor); &other != worst && !other.bad) other.error = {};
    worst->bad = true;
}

void AnchorHealth::note_blocked(std::int16_t anchor, double weight) noexcept {
    record(anchor).looks += weight;
    record(anchor).blocked_looks += weight;
}

void AnchorHealth::note_heard(std::int16_t anchor, Timestamp time) noexcept {
    Record& r = record(anchor);
    r.heard = r.heard ? std::max(*r.heard, time) : time;
}

bool AnchorHealth::step(Timestamp tick) noexcept {
    if (!stepped_) stepped_ = tick;
    const double since_s = to_s(tick - *stepped_);
    if (since_s < step_s) return false;
    stepped_ = tick;
    judge_anchors();
    for (std::size_t anchor = 0; anchor < records_.size(); ++anchor) {
        Record& r = records_[anchor];
        if (r.named) locate(r);
        if (r.named) acquit_if_well(r);
        describe(r, anchor, tick);
        r.evidence.fade(std::exp(-since_s / settings_.anchor_memory_s));
        r.recent.fade(std::exp(-since_s / naming_memory_s));
        r.elsewhere.fade(std::exp(-since_s / settings_.anchor_memory_s));
        r.looks *= std::exp(-since_s / blocked_memory_s);
        r.blocked_looks *= std::exp(-since_s / blocked_memory_s);
    }
    return true;
}

/// At most one a second: with it named the others look different.
void AnchorHealth::judge_anchors() noexcept {
    Record* worst = nullptr;
    double most = 0, next = 0;
    for (Record& r : records_) {
        if (r.named || r.recent.looks() < looks_to_name) continue;
        const double its = r.recent.test_of_both();
        next = std::max(next, std::min(most, its));
        if (its <= most) continue;
        most = its;
        worst = &r;
    }
    if (worst == nullptr || most < limit_ || !stands_out(most, next)) return;
    const AnchorEvidence::Constant constant = worst->recent.constant();
    const AnchorEvidence::Shift shift = worst->recent.shift();
    const double size_m = shift.test > constant.test ? shift.moved_m.norm() : std::abs(constant.error_m);
    if (size_m >= settings_.least_error_m) name(*worst);
}

/// What was seen until now was seen with the bad one among the others: all begin anew.
void AnchorHealth::name(Record& named) noexcept {
    named.named = true;
    for (Record& r : records_)
        if (!r.named || &r == &named) r.evidence = r.recent = {};
}

/// Whether it stands elsewhere, and where. The place is looked at anew when it turns out to be a good way off: what is
/// linear about one place is so only near it.
void AnchorHealth::locate(Record& r) const noexcept {
    const AnchorEvidence::Shift shift = r.evidence.shift();
    const AnchorEvidence::Constant constant = r.evidence.constant();
    if (!r.offset_m) {
        const bool moved = shift.test > limit_ && shift.test > constant.test + plainly && is_seen(shift) &&
                           shift.moved_m.norm() > settings_.least_error_m;
        if (moved) r.offset_m = shift.moved_m;
        return;
    }
    const AnchorEvidence::Shift beside = r.elsewhere.shift();
    if (is_seen(beside) && beside.moved_m.norm() > settings_.least_error_m) {
        *r.offset_m += beside.moved_m;
        r.elsewhere.clear();
    } else if (constant.test > shift.test + plainly) {
        r.offset_m.reset();
        r.elsewhere.clear();
    }
}

void AnchorHealth::acquit_if_well(Record& r) const noexcept {
    if (r.evidence.looks() < looks_to_name) return;
    const double least_m = well_share * settings_.least_error_m;
    if (r.evidence.shift().moved_m.norm() > least_m || std::abs(r.evidence.constant().error_m) > least_m) return;
    r.named = false;
    r.offset_m.reset();
    r.evidence.clear();
    r.elsewhere.clear();
}

bool AnchorHealth::is_mostly_blocked(const Record& r) noexcept { return r.blocked_looks > mostly * r.looks; }

AnchorState AnchorHealth::state_of(const Record& r, Timestamp tick) const noexcept {
    if (!r.heard) return AnchorState::not_heard;
    if (to_s(tick - *r.heard) > settings_.silent_after_s) return AnchorState::silent;
    if (r.named) return state_of_named(r);
    if (r.looks < looks_to_know && r.report.state != AnchorState::good) return AnchorState::joined;
    return is_mostly_blocked(r) ? AnchorState::blocked : AnchorState::good;
}

/// It stands elsewhere if that explains what is seen as chance allows; else it is too long everywhere, or no one knows.
AnchorState AnchorHealth::state_of_named(const Record& r) const noexcept {
    if (r.offset_m && r.elsewhere.looks() >= looks_to_know && r.elsewhere.shift().misfit < most_misfit)
        return AnchorState::moved;
    if (r.offset_m && r.report.state == AnchorState::moved && r.elsewhere.looks() < looks_to_know)
        return AnchorState::moved; // its place is being looked at anew
    const bool too_long =
        r.evidence.looks() >= looks_to_know && r.evidence.constant().error_m > well_share * settings_.least_error_m;
    return too_long || is_mostly_blocked(r) ? AnchorState::blocked : AnchorState::doubtful;
}

void AnchorHealth::describe(Record& r, std::size_t anchor, Timestamp tick) const noexcept {
    const AnchorState state = state_of(r, tick);
    if (state != r.report.state) r.report.since = tick;
    r.report.state = state;
    r.report.blocked_share = static_cast<float>(r.looks > 0 ? r.blocked_looks / r.looks : 0);
    const AnchorEvidence::Constant constant = r.evidence.constant();
    r.report.residual_m = constant.sigma_m > 0 ? static_cast<float>(constant.error_m) : unknown_f;
    r.report.residual_sigma_m = constant.sigma_m > 0 ? static_cast<float>(constant.sigma_m) : unknown_f;
    describe_place(r, anchor);
}

void AnchorHealth::describe_place(Record& r, std::size_t anchor) const noexcept {
    r.report.moved_m = unknown_f;
    r.report.stands_site_m = unknown_vec3f;
    r.report.stands_covariance_m2 = {};
    if (r.report.state != AnchorState::moved || !r.offset_m || r.elsewhere.looks() < looks_to_know) return;
    const AnchorEvidence::Shift shift = r.elsewhere.shift();
    const Eigen::Vector3d moved_m = *r.offset_m + shift.moved_m;
    r.report.moved_m = static_cast<float>(moved_m.norm());
    std::size_t entry = 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int other = axis; other < 3; ++other)
            r.report.stands_covariance_m2[entry++] = static_cast<float>(shift.covariance_m2(axis, other));
        const auto i = static_cast<std::size_t>(axis);
        if (shift.covariance_m2(axis, axis) < most_sigma_m * most_sigma_m)
            r.report.stands_site_m[i] = static_cast<float>(site_.anchors[anchor].position_site_m[i] + moved_m(axis));
    }
}

} // namespace locus::uwb
