// The register writes that start an Epson M-G370 (protocols.md 4.5), one at a time: the device needs a pause after
// each.
#pragma once

#include "drivers/imu/epson_g370.h"

namespace locus::imu {

/// One register write, or the choice of a window: three bytes.
using EpsonCommand = std::array<std::uint8_t, 3>;

/// In order: into configuration mode, rate, filter, fields, and into sampling mode.
std::vector<EpsonCommand> epson_start_commands(const EpsonSettings& settings);

class EpsonStart {
  public:
    explicit EpsonStart(const EpsonSettings& settings) : commands_(epson_start_commands(settings)) {}

    /// The command that is due; valid until the next call.
    std::optional<Packet> request(Timestamp now);
    void heard_burst() { heard_ = true; }
    void reset() { next_ = 0; }

  private:
    /// The device asks for 200 us, and for more after the filter was changed.
    static constexpr Duration pause = std::chrono::milliseconds{20};
    /// It was switched off and on again, or a command was lost.
    static constexpr Duration silence = std::chrono::seconds{3};

    std::vector<EpsonCommand> commands_;
    std::size_t next_ = 0;
    Timestamp last_{}; ///< command sent, or burst heard of
    bool heard_ = false;
};

} // namespace locus::imu
