// Where simulated and replayed bytes go: a pseudo-terminal of our own, a named pipe, a CAN interface, or a recording. A
// device that nobody reads loses its bytes, as a real one does; nothing here ever waits for a reader.
#pragma once

#include "config/settings.h"
#include "drivers/transport/transport.h"

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>

namespace locus::simulate {

class Output : public PacketSink {
  public:
    /// Whether somebody would take a packet now. A bus takes them all.
    virtual bool has_reader() { return true; }
    /// Packets that nobody took.
    std::uint64_t lost() const { return lost_; }

  protected:
    std::uint64_t lost_ = 0;
};

/// Whether bytes can be put into this transport: pty, fifo or can. The sentence says so when not.
std::string cannot_open(const InputSettings& input);

/// Throws std::runtime_error with a sentence when the device cannot be made. `input` is one that cannot_open() has
/// nothing against.
std::unique_ptr<Output> make_output(const InputSettings& input);

/// Lines of a *.log recording under the input's name. `stream` outlives it.
std::unique_ptr<Output> make_recorder(const InputSettings& input, std::ostream& stream);

} // namespace locus::simulate
