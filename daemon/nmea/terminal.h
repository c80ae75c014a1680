// A pseudo-terminal under a name of ours: gpsd and chart plotters open it as they open a receiver's serial line. It
// needs no network, so the service stays shut off from it.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <string>
#include <string_view>

namespace locus {

class NmeaTerminal {
  public:
    /// Makes the terminal and `link` to it; a link that is left from before is replaced, anything else is not.
    /// Everybody on the machine may read it. Throws std::runtime_error with a sentence that says what to do.
    explicit NmeaTerminal(const std::string& link);
    NmeaTerminal(NmeaTerminal&&) = default;
    NmeaTerminal& operator=(NmeaTerminal&&) = delete;
    ~NmeaTerminal();

    /// Never waits. Where nobody reads, or too slowly, what still waits is thrown away for these newer lines.
    void write(std::string_view lines);

  private:
    bool put(std::string_view bytes) const;

    std::string link_; ///< moved from: empty
    UniqueFd ours_;
    UniqueFd theirs_; ///< kept open, so that a reader may come and go
};

} // namespace locus
