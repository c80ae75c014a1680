// Driving a radio: range requests to the responders of the settings, one after the other, one outstanding at a time as
// the radio wants it (protocols.md 3.4). A radio that ranges by itself is left alone, but for a greeting when it is
// silent: as delivered it tells nobody anything until a host has spoken to it (RN_INTERFACE_NONE in the vendor's
// header).
#pragma once

#include "drivers/uwb/pulson/settings.h"
#include "fusion/time.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace locus::uwb::pulson {

class Requests {
  public:
    /// `responders` as in the settings; a list that cannot be read asks nobody (`locus check` has said so).
    Requests(std::string_view responders, Duration timeout);

    /// What is to be sent now, as a message without an envelope; empty while an answer is waited for.
    std::optional<std::vector<std::uint8_t>> next(Timestamp now);

    /// A range came that answers this message, good or bad. A confirm does not count: a radio that refuses is asked
    /// no faster than the timeout allows.
    void answered(std::uint16_t message);

    /// The radio said something.
    void heard(Timestamp time) { last_sign_ = time; }

    /// The line was opened anew: the answer will not come.
    void reset() {
        waiting_ = false;
        last_sign_.reset();
    }

  private:
    std::optional<std::vector<std::uint8_t>> greeting(Timestamp now);

    std::vector<std::uint32_t> responders_;
    Duration timeout_;
    std::size_t turn_ = 0;
    std::uint16_t message_ = 0; ///< of the last request
    bool waiting_ = false;
    Timestamp asked_{};
    std::optional<Timestamp> last_sign_; ///< of life: the radio's or, by a greeting, ours
};

} // namespace locus::uwb::pulson
