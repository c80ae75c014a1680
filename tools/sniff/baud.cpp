#include "tools/sniff/baud.h"

#include "tools/sniff/guess/frames.h"
#include "tools/sniff/guess/text.h"

#include <algorithm>

namespace locus::sniff {
namespace {

/// 0: noise. A wrong rate gives neither lines nor frames that follow one another.
double structure(const Capture& capture) {
    const auto bytes = capture.bytes();
    if (is_text(bytes) && lines_of(bytes).lines > 1) return 1;
    const auto frames = guess_frames(bytes);
    return frames ? frames->share : 0;
}

double worth(const std::vector<Standing>& found, const Capture& capture) {
    if (found.empty()) return structure(capture);
    return found.front().confidence == Confidence::sure ? 3 : 2;
}

} // namespace

std::optional<BaudRate> find_baud_rate(const std::function<std::optional<Capture>(int baud_bd)>& listen) {
    std::optional<BaudRate> best;
    double best_worth = 0;
    for (const int baud_bd : usual_baud_rates) {
        const auto capture = listen(baud_bd);
        if (!capture) break;
        if (capture->empty()) continue;
        auto found = winners(contest(*capture));
        const double here = worth(found, *capture);
        if (here <= best_worth) continue;
        best = BaudRate{baud_bd, std::move(found)};
        best_worth = here;
        if (here >= 3) break;
    }
    return best;
}

} // namespace locus::sniff
