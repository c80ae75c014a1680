// What any thread may read of an input while its own thread runs: counters, state, and the last thing that went wrong.
// One writer (the input's thread), any number of readers.
#pragma once

#include "drivers/decoder.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace locus {

enum class InputState : std::uint8_t {
    starting, ///< the device was not tried yet
    open,     ///< reading
    waiting,  ///< could not be opened, or was lost; tried again after a while. error() says why
    ended,    ///< a recording was read to its end; the thread is done
    stopped,  ///< run() came back because it was asked to
};

inline constexpr std::array<std::string_view, 5> input_state_names{"starting", "open", "waiting", "ended", "stopped"};

constexpr std::string_view name_of(InputState state) { return input_state_names[static_cast<std::size_t>(state)]; }

/// A sentence that one thread writes rarely and others read. Bounded, because a device may put its own text in it.
class SharedText {
  public:
    static constexpr std::size_t max_size = 240;

    void set(std::string_view text) {
        const std::lock_guard lock{mutex_};
        text_ = text.substr(0, max_size);
    }
    std::string get() const {
        const std::lock_guard lock{mutex_};
        return text_;
    }

  private:
    mutable std::mutex mutex_;
    std::string text_;
};

struct InputStatus {
    using Counter = std::atomic<std::uint64_t>;

    std::atomic<InputState> state{InputState::starting};
    Counter bytes{0};
    Counter packets{0};
    Counter frames{0};       ///< whole frames that the decoder understood
    Counter measurements{0}; ///< what the decoder gave, also what the ring then dropped
    std::array<Counter, refusal_count> refused{};
    Counter resyncs{0};        ///< times that the decoder had to look for the next frame after damage
    Counter reconnects{0};     ///< times that the device was opened again after a loss
    Counter ring_dropped{0};   ///< measurements lost because the fusion thread did not keep up
    Counter kernel_dropped{0}; ///< frames lost in the kernel because this thread did not keep up
    Counter wire_errors{0};    ///< error frames of a CAN bus
    /// Stamp of the newest packet, ns of CLOCK_MONOTONIC; 0: none yet.
    std::atomic<std::int64_t> last_packet_ns{0};
    /// Why it is waiting; while open: a trouble that does not stop it ("can0 is error passive"). Empty when all is
    /// well.
    SharedText trouble;
    SharedText doing;                           ///< in a sentence, where an input has more states than these
    SharedText last_error;                      ///< the newest trouble, also when it is over
    std::atomic<std::int64_t> last_error_ns{0}; ///< when it came, ns of CLOCK_MONOTONIC; 0: there was none
};

} // namespace locus
