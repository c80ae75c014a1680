// Signals as a descriptor. Block them in main() before the first thread starts: threads inherit the mask.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <initializer_list>

namespace locus {

class Signals {
  public:
    /// Blocks `signals` in the calling thread and ignores SIGPIPE. Throws std::system_error.
    explicit Signals(std::initializer_list<int> signals);

    /// The next one that came, 0 when none has.
    int next() const;

    int fd() const { return fd_.get(); }

  private:
    UniqueFd fd_;
};

} // namespace locus
