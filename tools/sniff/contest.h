// Which of the known formats is it? Every decoder that needs no description of its own reads what was captured, and
// what it understands is weighed by how easily it would understand nonsense: a damaged copy of the same bytes is read
// as well, and a format that takes most of the damaged frames has no checksum to speak of.
#pragma once

#include "tools/sniff/capture.h"
#include "tools/sniff/tally.h"

#include <memory>
#include <vector>

namespace locus::sniff {

enum class Confidence : std::uint8_t {
    none,   ///< it understands something, but so it might by chance
    likely, ///< a format without a checksum, or few frames: the values must make sense
    sure,   ///< frames that damage would have spoilt, enough of them
};

struct Standing {
    const DecoderRow* decoder = nullptr;
    std::shared_ptr<void> settings; ///< the defaults, but perhaps for one that had to be another
    Tally tally;
    double share = 0;     ///< of the bytes (CAN: of the frames) explained
    bool guarded = false; ///< damaged frames are refused
    Confidence confidence = Confidence::none;
};

/// Those that understood anything, the best first.
std::vector<Standing> contest(const Capture& capture);

/// The best one when it is convincing, and with it those of `standings` that are as well: either they share the line,
/// or they cannot be told apart.
std::vector<Standing> winners(const std::vector<Standing>& standings);

/// What a decoder with these settings makes of it all.
Tally tally_of(const Capture& capture, const DecoderRow& decoder, const void* settings);

} // namespace locus::sniff
