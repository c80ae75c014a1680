// How long the frames are that begin at anchors: all the same, or as a number in each of them says.
#pragma once

#include "tools/sniff/guess/anchors.h"

#include <optional>
#include <vector>

namespace locus::sniff {

struct LengthRule {
    std::size_t fixed = 0; ///< 0: the frame says it
    std::size_t at = 0;    ///< counted from the anchor
    std::size_t bytes = 1;
    bool big = false;
    int adds = 0;
};

/// A stretch of the stream.
struct Cut {
    std::size_t begin, length;
};

struct Framing {
    LengthRule rule;
    std::vector<Cut> frames; ///< those that are followed by another one at once, or by the end of the stream
    double share = 0;        ///< of the stream that they cover
};

/// Those that explain where most of the anchors stand.
std::vector<Framing> guess_lengths(wire::Bytes bytes, const Anchor& anchor);

} // namespace locus::sniff
