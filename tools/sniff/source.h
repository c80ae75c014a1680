// What `locus sniff` was told to listen to: an input of a configuration, a device by its name, or a file.
#pragma once

#include "config/settings.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace locus::sniff {

struct SourceRequest {
    std::string input;    ///< as typed
    std::string config;   ///< empty: none
    std::string decoder;  ///< empty: that of the configuration, or none
    std::string recorded; ///< input whose lines of a recording are wanted; empty: there is only one
    int baud_bd = 0;      ///< 0: not given
};

struct Source {
    const TransportRow* transport = nullptr; ///< null: a file of raw bytes
    std::shared_ptr<void> transport_settings;
    const DecoderRow* decoder = nullptr; ///< null: to be found out
    std::shared_ptr<void> decoder_settings;
    std::string path;     ///< of a file
    bool is_file = false; ///< it ends by itself

    std::unique_ptr<Transport> make_transport() const;
    /// The transport's lines of a configuration for a decoder, with the device's name that survives replugging.
    std::vector<std::string> lines(const DecoderRow& reader) const;
    bool has_baud_rate() const { return transport && transport->name == "serial"; }
    /// Of this one alone, not of those that it was copied from.
    void set_baud_rate(int baud_bd);
};

/// Opens nothing but files. On failure a sentence that says what to type instead.
std::optional<Source> find_source(const SourceRequest& request, std::string& error);

} // namespace locus::sniff
