// What the transport tests share: transports made as the settings loader makes them, and a sink that keeps packets.
#pragma once

#include "drivers/transport/transport.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace locus::testing_transport {

using Values = std::map<std::string, OptionValue>;

inline std::unique_ptr<Transport> make_transport(std::string_view name, const Values& values) {
    const TransportRow* row = find_transport(name);
    if (!row) throw std::runtime_error("no transport " + std::string{name});
    const std::shared_ptr<void> settings = row->options.make();
    for (const auto& [key, value] : values) {
        const auto& rows = row->options.rows;
        const auto option = std::find_if(rows.begin(), rows.end(), [&](const OptionRow& o) { return o.name == key; });
        if (option == rows.end()) throw std::runtime_error("no option " + key);
        option->set(settings.get(), value);
    }
    return row->make(settings.get());
}

struct KeptPacket {
    Packet packet; ///< its data is gone
    std::vector<std::uint8_t> data;
};

class KeepingSink : public PacketSink {
  public:
    void packet(const Packet& packet) override {
        kept.push_back({packet, {packet.data.begin(), packet.data.end()}});
        kept.back().packet.data = {};
        text.append(packet.data.begin(), packet.data.end());
    }
    std::vector<KeptPacket> kept;
    std::string text;
};

/// Reads until `size` bytes came, something was lost, or five seconds went by.
inline ReadStatus read_bytes(Transport& transport, KeepingSink& sink, std::size_t size) {
    ReadStatus status = ReadStatus::ok;
    for (int i = 0; i < 50 && status == ReadStatus::ok && sink.text.size() < size; ++i) {
        status = transport.read(sink, std::chrono::milliseconds{100});
    }
    return status;
}

inline ReadStatus read_until_lost(Transport& transport, KeepingSink& sink) {
    return read_bytes(transport, sink, std::string::npos);
}

} // namespace locus::testing_transport
