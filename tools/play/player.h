// The recording read line by line, each packet given to its device when it is due.
#pragma once

#include "config/settings.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace locus::play {

struct Request {
    std::string recording;
    double speed = 1;
};

struct Result {
    static constexpr std::size_t most_told = 10;

    std::uint64_t played = 0; ///< packets, also those that were lost
    std::uint64_t lost = 0;   ///< nobody read them
    double took_s = 0;
    std::map<std::string, std::uint64_t> of_unknown_inputs; ///< lines
    std::uint64_t bad_lines = 0;
    std::vector<std::string> problems; ///< a sentence for each of the first bad lines
};

/// Makes the devices of the enabled inputs, waits until all have a reader, and plays. Ends early on Ctrl-C. Throws
/// std::runtime_error with a sentence when the file or a device cannot be used.
Result play(const std::vector<InputSettings>& inputs, const Request& request);

std::string result_json(const Result& result);

} // namespace locus::play
