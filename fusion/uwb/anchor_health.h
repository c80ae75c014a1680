// The health of every anchor: epochs of all tags in, a state for each anchor out. Two questions with a memory each:
// - is the path from this anchor to this tag blocked? Seconds of one tag's epochs tell.
// - is the anchor itself wrong? A minute of all tags' epochs tells, and from which sides its ranges are too long or too
//   short tells whether it stands elsewhere.
// An error is never seen by itself, it only spoils agreement. So of all anchors the one is named whose error explains
// most, only if the next one explains plainly less, and from then on it has an unknown of its own in every epoch, so
// that the others are judged without it. It only tells: no pose depends on it.
#pragma once

#include "fusion/anchor_report.h"
#include "fusion/site.h"
#include "fusion/uwb/anchor_evidence.h"
#include "fusion/uwb/anchor_health_settings.h"
#include "fusion/uwb/leave_one_out.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace locus::uwb {

class AnchorHealth {
  public:
    using Target = std::uint16_t;

    /// `site` outlives it. Memory for `targets` targets is set aside now; later ones are not judged by.
    AnchorHealth(const Site& site, const AnchorHealthSettings& settings, std::size_t targets);

    /// One epoch of a target, with the newest line last.
    struct Epoch {
        Target target = 0;
        Timestamp time{};
        double weight = 1; ///< 0..1 of a look that is independent of the one before
        std::span<const SightLine> lines;
        EpochPrior prior;
    };
    /// What all ranges of the epoch have in common; nothing where too few anchors are in it to tell.
    struct Common {
        double error_m = 0;
        double variance_m2 = 0;
    };
    std::optional<Common> take(const Epoch& epoch) noexcept;

    /// The device itself calls the path blocked.
    void note_blocked(std::int16_t anchor, double weight) noexcept;

    /// An anchor was heard, by whatever tag or other anchor.
    void note_heard(std::int16_t anchor, Timestamp time) noexcept;

    /// Once a tick. True about once a second: then the reports are new.
    bool step(Timestamp tick) noexcept;

    /// By the order of anchors in the site.
    const AnchorReport& report(std::size_t anchor) const noexcept { return records_[anchor].report; }

    /// Whether the path from this anchor to this target is taken for blocked, or the anchor for wrong.
    bool in_doubt(Target target, std::int16_t anchor) const noexcept;

  private:
    struct Path {
        Timestamp time = Timestamp::min();
        AnchorError error;
        bool bad = false;
    };
    struct Record {
        AnchorEvidence evidence;
        /// Of a quarter of a minute: an anchor goes bad at some moment, and what was before it speaks against that.
        AnchorEvidence recent;
        /// The same about the place where a moved anchor seems to stand: there it is linear, however far it is.
        AnchorEvidence elsewhere;
        std::optional<Eigen::Vector3d> offset_m; ///< of that place from the settings'
        std::optional<Timestamp> heard;
        double looks = 0, blocked_looks = 0;
        bool named = false;
        AnchorReport report;
    };
    using Anchors = std::array<std::int16_t, LeaveOneOut::max_in_doubt>;

    Path& path(Target target, std::int16_t anchor) noexcept;
    const Path& path(Target target, std::int16_t anchor) const noexcept;
    Record& record(std::int16_t anchor) noexcept { return records_[static_cast<std::size_t>(anchor)]; }
    std::size_t doubts_of(Target target, Anchors& doubts) const noexcept;
    void collect_anchors(std::span<const SightLine> lines) noexcept;
    int spare(const Epoch& epoch, std::size_t doubts) const noexcept;
    void look(const Epoch& epoch, std::int16_t anchor, const LeaveOneOut& leave_one_out, bool checked) noexcept;
    void remember(Path& path, const AnchorError& error, const Epoch& epoch) const noexcept;
    void judge_paths(const Epoch& epoch) noexcept;
    void judge_anchors() noexcept;
    void name(Record& named) noexcept;
    void locate(Record& record) const noexcept;
    void acquit_if_well(Record& record) const noexcept;
    void describe_place(Record& record, std::size_t anchor) const noexcept;
    void describe(Record& record, std::size_t anchor, Timestamp tick) const noexcept;
    AnchorState state_of(const Record& record, Timestamp tick) const noexcept;
    AnchorState state_of_named(const Record& record) const noexcept;
    static bool is_mostly_blocked(const Record& record) noexcept;

    const Site& site_;
    AnchorHealthSettings settings_;
    double limit_; ///< chi-square of one degree of freedom
    std::vector<Record> records_;
    std::vector<Path> paths_;            ///< targets times anchors
    std::vector<std::int16_t> in_epoch_; ///< anchors of the epoch that is looked at
    std::optional<Timestamp> stepped_;
};

} // namespace locus::uwb
