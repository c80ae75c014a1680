// Recordings of measurements (.jsonl), to be put together with other files.
#include "drivers/recording/measurement_json.h"
#include "tools/import/lines.h"
#include "tools/import/source.h"

namespace locus::importing {
namespace {

class MeasurementSource final : public Source {
  public:
    explicit MeasurementSource(const std::string& path) : lines_{path} { report_.clock = "the recording's clock"; }

    bool read(std::vector<Item>& items) override {
        std::string_view line;
        if (!lines_.next(line)) return false;
        if (line.empty() || line.front() == '#') return true;
        std::string error;
        const auto measurement = from_json_line(line, error);
        if (measurement)
            items.push_back({measurement->time, measurement->observation});
        else
            report_.problem("line " + std::to_string(lines_.number()) + ": " + error);
        return true;
    }

  private:
    Lines lines_;
};

} // namespace

std::unique_ptr<Source> open_measurements(const std::string& path) { return std::make_unique<MeasurementSource>(path); }

} // namespace locus::importing
