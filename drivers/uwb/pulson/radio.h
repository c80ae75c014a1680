// What a PulsON radio says becomes ranges, whatever line its messages came over.
#pragma once

#include "drivers/decoder.h"
#include "drivers/uwb/pulson/messages.h"
#include "drivers/uwb/pulson/neighbors.h"
#include "drivers/uwb/pulson/requests.h"
#include "drivers/uwb/pulson/settings.h"

#include <array>
#include <optional>

namespace locus::uwb::pulson {

class Radio {
  public:
    explicit Radio(const PulsonSettings& settings);

    /// One whole message, without its envelope; `time` is when it began on the wire.
    void message(wire::Bytes bytes, Timestamp time, MeasurementSink& sink);

    std::optional<std::vector<std::uint8_t>> request(Timestamp now) { return requests_.next(now); }
    void reset();

  private:
    /// One range as a message has it, before it is known whose.
    struct Said {
        std::uint64_t range_mm;
        std::uint32_t sigma_mm; ///< 0: not said
        LineOfSight line_of_sight = LineOfSight::unknown;
    };
    struct Echo {
        std::uint32_t requester;
        std::uint32_t timestamp;
        bool operator==(const Echo&) const = default;
    };

    template <class Message>
    void read(wire::Bytes bytes, Timestamp time, MeasurementSink& sink);
    void use(const FullRange& range, Timestamp time, MeasurementSink& sink);
    void use(const SmallRange& range, Timestamp time, MeasurementSink& sink);
    void use(const EchoedRange& range, Timestamp time, MeasurementSink& sink);
    void use(const FullNeighbors& database, Timestamp time, MeasurementSink& sink);
    void use(const SmallNeighbors& database, Timestamp time, MeasurementSink& sink);

    bool takes(std::uint8_t status, std::uint8_t parts, Part wanted) const;
    bool heard_before(const Echo& echo);
    bool ranges_come_by_themselves(Timestamp time) const;
    void give(std::uint32_t other, const Said& said, Timestamp time, MeasurementSink& sink) const;

    PulsonSettings settings_;
    Requests requests_;
    std::array<Echo, 16> echoes_{};
    std::size_t next_echo_ = 0;
    std::optional<Timestamp> last_range_;
    std::optional<Timestamp> last_small_database_;
    std::optional<std::uint32_t> last_full_database_ms_; ///< in the radio's clock
};

} // namespace locus::uwb::pulson
