#include "tools/replay/recording.h"

#include "drivers/recording/measurement_json.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace locus::replay {
namespace {

class MeasurementReader final : public LineReader {
  public:
    explicit MeasurementReader(Take take) : take_(std::move(take)) {}

    void read(std::string_view line, std::string& error) override {
        if (line.empty() || line.front() == '#') return;
        if (const auto measurement = from_json_line(line, error)) take_(*measurement, measurement->time);
    }

  private:
    Take take_;
};

std::unique_ptr<LineReader> reader_for(const std::string& path, const Settings& settings, const Take& take,
                                       ReadReport& report) {
    if (path.ends_with(".jsonl")) return measurement_reader(take);
    if (path.ends_with(".log")) return raw_reader(settings, take, report);
    throw std::runtime_error("'" + path +
                             "' is no recording: its name ends neither in .jsonl (measurements) nor in "
                             ".log (raw input)");
}

std::ifstream opened(const std::string& path) {
    std::ifstream file{path};
    const bool readable = file && (file.peek() != std::ifstream::traits_type::eof() || file.eof()); // a folder is not
    if (!readable) throw std::runtime_error("'" + path + "' cannot be read: " + std::strerror(errno));
    return file;
}

void note(ReadReport& report, const std::string& error) {
    if (++report.bad_lines <= ReadReport::most_told)
        report.problems.push_back("line " + std::to_string(report.lines) + ": " + error);
}

} // namespace

std::unique_ptr<LineReader> measurement_reader(Take take) {
    return std::make_unique<MeasurementReader>(std::move(take));
}

ReadReport read_recording(const std::string& path, const Settings& settings, const Take& take) {
    ReadReport report;
    const auto reader = reader_for(path, settings, take, report);
    std::ifstream file = opened(path);
    for (std::string line; std::getline(file, line);) {
        if (line.ends_with('\r')) line.pop_back();
        ++report.lines;
        std::string error;
        reader->read(line, error);
        if (!error.empty()) note(report, error);
    }
    return report;
}

} // namespace locus::replay
