// Transport: where bytes or CAN frames come from. It knows no protocol. read() blocks for at most its timeout, so the
// input's thread sees a stop request; a lost device is closed here and opened again by drivers/input.h, for ever.
#pragma once

#include "drivers/packet.h"
#include "fusion/option.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace locus {

class PacketSink {
  public:
    virtual ~PacketSink() = default;
    virtual void packet(const Packet& packet) = 0;
};

enum class ReadStatus : std::uint8_t {
    ok,    ///< something or nothing came within the timeout
    lost,  ///< the device is gone; last_error() says how
    ended, ///< a recording was read to its end
};

class Transport {
  public:
    virtual ~Transport() = default;
    /// False: last_error() holds a sentence that says what is wrong and what to do.
    virtual bool open() = 0;
    virtual void close() = 0;
    virtual ReadStatus read(PacketSink& sink, Duration timeout) = 0;
    /// For devices that must be asked: the bytes, or the CAN frame. False when it did not go out whole.
    virtual bool write(const Packet& /*packet*/) { return false; }
    /// Frames that the kernel dropped, as it says; counts on over re-opening.
    virtual std::uint64_t kernel_dropped() const { return 0; }
    /// Error frames of a bus; counts on over re-opening.
    virtual std::uint64_t wire_errors() const { return 0; }
    /// A trouble that does not stop it, in a sentence ("can0 is error passive ..."); empty when all is well.
    virtual std::string_view trouble() const { return {}; }
    virtual std::string_view last_error() const = 0;
};

struct TransportRow {
    std::string_view name;
    std::string_view about;
    std::optional<Wire> wire; ///< empty: either kind (a recording holds both)
    bool needs_network;       ///< opens an IP socket: the unit's drop-in must allow AF_INET
    OptionTable options;
    std::unique_ptr<Transport> (*make)(const void* settings);
    std::string_view sole_option{}; ///< names a device that one reader alone can have; empty: there is none such

    /// Whether a decoder of that wire can be fed by it.
    constexpr bool carries(Wire wanted) const { return !wire || *wire == wanted; }
};

std::span<const TransportRow> transport_table();
const TransportRow* find_transport(std::string_view name);

} // namespace locus
