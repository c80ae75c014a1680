// What serial ports, pseudo-terminals, named pipes and TCP connections share once they are open: a file descriptor
// that gives bytes. Each of them only opens its own kind.
#pragma once

#include "drivers/transport/transport.h"
#include "drivers/transport/unique_fd.h"

#include <string>

namespace locus {

class StreamTransport : public Transport {
  public:
    void close() override { fd_.reset(); }
    /// The bytes of one wake-up, stamped right after the wait (CLOCK_MONOTONIC), in packets of at most `max_packet`.
    ReadStatus read(PacketSink& sink, Duration timeout) override;
    bool write(const Packet& packet) override;
    std::string_view last_error() const override { return error_; }

    /// Longer packets would make lines of a recording that canplayer refuses to skip (400 characters).
    static constexpr std::size_t max_packet = 128;

  protected:
    explicit StreamTransport(std::string device) : device_{std::move(device)} {}
    /// For open(): keeps the sentence, gives false.
    bool refuse(std::string sentence);

    const std::string device_; ///< path or address, as the settings and the log call it
    UniqueFd fd_;
    Duration byte_time_{0};

  private:
    ReadStatus take(PacketSink& sink, Timestamp woken);
    void hand_over(std::span<const std::uint8_t> bytes, Timestamp woken, PacketSink& sink) const;
    ReadStatus lost(std::string_view how);

    std::string error_;
};

/// Keeps other programs of ours off the device, also those of root, whom TIOCEXCL does not stop. False: one has it.
bool lock_device(int fd);

/// "'/dev/x' is in use ...".
std::string in_use_sentence(const std::string& path);

/// Opens a path for reading and writing, for this program alone, without ever blocking. On failure the sentence says
/// what `kind` of device was wanted and what to do.
UniqueFd open_device(const std::string& path, std::string_view kind, std::string& error);

} // namespace locus
