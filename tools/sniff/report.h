// What `locus sniff` says of a device without a decoder: who understood it, or what it looks like, and what to type.
#pragma once

#include "tools/sniff/census.h"
#include "tools/sniff/contest.h"
#include "tools/sniff/guess/frames.h"
#include "tools/sniff/guess/text.h"
#include "tools/sniff/source.h"

#include <optional>
#include <string>
#include <vector>

namespace locus::sniff {

struct Findings {
    std::size_t bytes = 0, packets = 0;
    Duration duration{};
    Wire wire = Wire::bytes;
    std::vector<Standing> standings;
    std::vector<Standing> winners;
    std::vector<Census> ids;         ///< CAN
    std::optional<TextLines> text;   ///< bytes that are text
    std::optional<FrameGuess> guess; ///< bytes that are none, and that no decoder knows

    /// Something that a configuration can be made of.
    bool any() const { return !winners.empty() || guess.has_value(); }
};

Findings look_into(const Capture& capture);

std::vector<std::string> findings_lines(const Findings& findings, const Source& source);
std::string findings_json(const Findings& findings, const Source& source);

/// An input of a configuration, to be pasted.
std::string input_yaml(const Standing& standing, const Source& source);
std::string input_yaml(const FrameGuess& guess, const Source& source);

} // namespace locus::sniff
