#include "daemon/socket/reason_watch.h"

namespace locus {

std::optional<Exclusion> ReasonWatch::see(const AidStatus& source, Timestamp now) {
    Told& told = told_[{source.kind, source.source}];
    const Exclusion reason = source.last_verdict.reason;
    const bool too_soon = told.when && now - *told.when < pause;
    if (reason == told.reason || too_soon) return {};
    told = {reason, now};
    return reason;
}

} // namespace locus
