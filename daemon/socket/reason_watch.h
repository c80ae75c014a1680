// When the log should say that a source is now used, or not, and why: when the reason has changed, not each cycle, and
// for one source at most every ten seconds. A source that flaps is told once, and again when the pause is over.
#pragma once

#include "fusion/aid_status.h"

#include <map>
#include <optional>
#include <utility>

namespace locus {

class ReasonWatch {
  public:
    static constexpr Duration pause = std::chrono::seconds{10};

    /// The reason to tell; empty when there is nothing new to say now.
    std::optional<Exclusion> see(const AidStatus& source, Timestamp now);

  private:
    struct Told {
        Exclusion reason = Exclusion::not_seen_yet;
        std::optional<Timestamp> when;
    };
    std::map<std::pair<SourceKind, Address>, Told> told_;
};

} // namespace locus
