// Watches the anchors while the engine works: gathers what each tag hears into epochs, beside the tag's pose, and hands
// them to the judgement of the anchors (uwb/anchor_health.h). It hears every measurement once, when it comes in: a
// roll-back of the estimators changes poses, not what was heard.
#pragma once

#include "fusion/aid_book.h"
#include "fusion/estimators/range_reader.h"
#include "fusion/pose.h"
#include "fusion/uwb/anchor_health.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace locus {

class AnchorWatch {
  public:
    /// `site` outlives it. All memory is set aside now.
    AnchorWatch(const Site& site, const uwb::AnchorHealthSettings& settings, std::size_t targets);

    /// A measurement that the target in this slot will take.
    void hear(std::uint16_t slot, const Measurement& measurement) noexcept;

    /// After the poses of a tick: `poses` by slot. The book learns how the anchors do.
    void step(Timestamp tick, std::span<const Pose> poses, AidBook& book) noexcept;

  private:
    static constexpr std::size_t most_lines = uwb::LeaveOneOut::max_lines;
    /// Tags that hear more than this in one tick are judged by a part of it.
    static constexpr std::size_t most_waiting = 4096;

    struct Waiting {
        std::uint16_t slot = 0;
        uwb::Sighting sighting;
        Timestamp time{};
    };
    /// What one tag has heard since its last epoch ended.
    struct Gathering {
        std::array<uwb::SightLine, most_lines> lines{};
        std::size_t size = 0;
        Timestamp opened{};
        Timestamp newest{};
        std::optional<Timestamp> judged;
        double common_m = 0, common_variance_m2 = 0; ///< of the error that all ranges of the tag have in common
    };

    void gather(const Waiting& heard, const Estimate& estimate) noexcept;
    uwb::SightLine line_of(const Waiting& heard, const Estimate& estimate) const noexcept;
    void close(std::uint16_t slot, const Estimate& estimate) noexcept;
    void learn(Gathering& gathering, const uwb::AnchorHealth::Common& common, double weight) const noexcept;

    const Site& site_;
    uwb::AnchorHealthSettings settings_;
    RangeReader reader_;
    uwb::AnchorHealth health_;
    std::vector<Waiting> waiting_;
    std::vector<Gathering> gatherings_;
};

} // namespace locus
