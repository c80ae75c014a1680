// How fast each input brings something: its counters of some seconds ago, kept beside those of now.
#pragma once

#include "daemon/socket/roster.h"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>

namespace locus {

/// Per second, over the last seconds.
struct InputRate {
    double bytes = 0, packets = 0, frames = 0, measurements = 0;
};

class InputRates {
  public:
    static constexpr Duration step = std::chrono::seconds{1};
    static constexpr std::size_t steps_kept = 5;

    /// Looks at the counters, once a `step` however often it is called. Inputs that are no more are forgotten.
    void watch(const std::vector<InputEntry>& inputs, Timestamp now);

    /// From the oldest look that is kept until now. Empty as long as there was none a step ago.
    std::optional<InputRate> rate(const InputStatus& status, Timestamp now) const;

  private:
    using Counts = std::array<std::uint64_t, 4>;
    struct Look {
        Timestamp time;
        Counts counts;
    };
    struct Watched {
        std::shared_ptr<const InputStatus> status; ///< held, so that its address stays its own
        std::deque<Look> looks;                    ///< oldest first
    };
    static Counts counts_of(const InputStatus& status);

    std::map<const InputStatus*, Watched> inputs_;
    std::optional<Timestamp> last_;
};

} // namespace locus
