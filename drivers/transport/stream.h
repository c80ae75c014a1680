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
    /// One packet per wake-up, at most `max_chunk` bytes, stamped right after the wait (CLOCK_MONOTONIC).
    ReadStatus read(PacketSink& sink, Duration timeout) override;
    bool write(std::span<const std::uint8_t> bytes) override;
    std::string_view last_error() const override { return error_; }

    static constexpr std::size_t max_chunk = 4096;

  protected:
    explicit StreamTransport(std::string device) : device_{std::move(device)} {}
    /// For open(): keeps the sentence, gives false.
    bool refuse(std::string sentence);

    const std::string device_; ///< path or address, as the settings and the log call it
    UniqueFd fd_;
    Duration byte_time_{0};

  private:
    ReadStatus take(PacketSink& sink, Timestamp woken);
    ReadStatus lost(std::string_view how);

    std::string error_;
};

/// Opens a path for reading and writing without ever blocking. On failure the sentence says what `kind` of device was
/// wanted and what to do.
UniqueFd open_device(const std::string& path, std::string_view kind, std::string& error);

} // namespace locus
