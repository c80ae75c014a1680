// Reads a recording line by line: *.jsonl holds measurements, *.log raw input that goes through the decoders of the
// settings. A bad line is counted and told; reading goes on.
#pragma once

#include "config/settings.h"
#include "drivers/decoder.h"
#include "fusion/measurement.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace locus::replay {

/// Gets the measurements in the order of the file, with the time at which each came. Lines of decoded measurements do
/// not say when they came: then it is the sample's own time.
using Take = std::function<void(const Measurement&, Timestamp arrival)>;

struct ReadReport {
    /// Bad lines that are told one by one; the rest is only counted.
    static constexpr std::size_t most_told = 10;

    std::uint64_t lines = 0;
    std::uint64_t bad_lines = 0;
    std::vector<std::string> problems; ///< "line 7: why"
    /// Raw lines left out because no enabled input of the settings has this name.
    std::map<std::string, std::uint64_t> lines_of_unknown_inputs;
    std::array<std::uint64_t, refusal_count> refused{}; ///< by the decoders; index: Refusal
};

class LineReader {
  public:
    virtual ~LineReader() = default;
    /// `error` stays empty unless the line cannot be read.
    virtual void read(std::string_view line, std::string& error) = 0;
};

std::unique_ptr<LineReader> measurement_reader(Take take);

/// `settings` and `report` outlive the reader.
std::unique_ptr<LineReader> raw_reader(const Settings& settings, Take take, ReadReport& report);

/// Throws std::runtime_error with a sentence when the file cannot be read at all or its name ends in neither.
ReadReport read_recording(const std::string& path, const Settings& settings, const Take& take);

} // namespace locus::replay
