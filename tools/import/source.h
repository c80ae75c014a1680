// One file of a GNSS receiver or of a navigation service, read piece by piece: measurements with GPS time, as GPS
// seconds since 1980-01-06, which is the clock of what is imported. Poses of a SLAM and recordings of measurements have
// the clock they come with.
#pragma once

#include "drivers/decoder.h"
#include "drivers/slam/tum.h"
#include "fusion/measurement.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace locus::importing {

/// What was found in a file.
struct FileReport {
    /// Problems that are told one by one; the rest is only counted.
    static constexpr std::size_t most_told = 10;

    std::string path;
    std::string_view kind;
    std::string_view clock = "GPS time"; ///< of `first` and `last`
    std::uint64_t bad = 0;
    std::vector<std::string> problems;             ///< "line 7: why"
    std::map<std::string, std::uint64_t> left_out; ///< by reason
    std::array<std::uint64_t, refusal_count> refused{};
    std::map<std::string_view, std::uint64_t> given; ///< by name of the kind of measurement
    std::optional<Timestamp> first;
    Timestamp last{};

    void problem(const std::string& sentence) {
        if (++bad <= most_told) problems.push_back(sentence);
    }
};

struct Item {
    Timestamp time;
    Observation observation;
};

class Source {
  public:
    virtual ~Source() = default;
    /// Appends what comes next, nothing where the next piece holds no measurement. False at the file's end.
    virtual bool read(std::vector<Item>& items) = 0;
    FileReport& report() { return report_; }

  protected:
    FileReport report_;
};

/// Puts into a list what a decoder gives.
class ListSink : public MeasurementSink {
  public:
    ListSink(std::vector<Item>& items, FileReport& report) : items_{items}, report_{report} {}
    void accept(Timestamp time, const Observation& observation) override { items_.push_back({time, observation}); }
    void refuse(Refusal reason) override { ++report_.refused[static_cast<std::size_t>(reason)]; }

  private:
    std::vector<Item>& items_;
    FileReport& report_;
};

/// By channel number + 7.
using GlonassSlots = std::map<std::uint8_t, std::uint8_t>;

std::unique_ptr<Source> open_rinex_observations(const std::string& path, Address tag, GlonassSlots slots);
std::unique_ptr<Source> open_ubx_log(const std::string& path, Address tag);
std::unique_ptr<Source> open_nmea_log(const std::string& path, Address tag);
/// `shift_s` is added to the stamps; `settings.stamps` does not matter.
std::unique_ptr<Source> open_tum_poses(const std::string& path, const slam::TumSettings& settings, double shift_s);
std::unique_ptr<Source> open_measurements(const std::string& path);

} // namespace locus::importing
