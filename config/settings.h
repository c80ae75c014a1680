// Everything a configuration file says, checked. config/load.h makes it.
#pragma once

#include "config/camera_input.h"
#include "config/nmea_settings.h"
#include "config/row_option.h"
#include "drivers/decoder.h"
#include "drivers/transport/transport.h"
#include "fusion/engine.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace locus {

struct InputSettings {
    std::string name;
    const TransportRow* transport = nullptr;
    std::shared_ptr<void> transport_settings;
    const DecoderRow* decoder = nullptr;
    std::shared_ptr<void> decoder_settings;
    double delay_s = 0; ///< from the sample to the wire, taken off every stamp
    bool enabled = true;
};

/// The rows that stand in front of the transport's and the decoder's own.
inline constexpr std::array input_options{
    required_option<&InputSettings::name>("name", "Name that people see and recordings carry, one word."),
    row_option<&InputSettings::transport, find_transport>("transport",
                                                          "Where it comes from: one of the transports below."),
    row_option<&InputSettings::decoder, find_decoder>("decoder", "What it speaks: one of the decoders below."),
    option<&InputSettings::delay_s>("delay_s", "s", 0, 10, "Time from the sample to the wire, taken off every stamp."),
    option<&InputSettings::enabled>("enabled", "Whether the input is opened at all."),
};

struct PublishSettings {
    std::string socket = "/run/locusd/locusd.sock";
    int max_clients = 64;
    int client_queue = 256;
};

inline constexpr std::array publish_options{
    option<&PublishSettings::socket>("socket", "Path of the UNIX socket, when systemd does not hand one over."),
    option<&PublishSettings::max_clients>("max_clients", "", 1, 1024, "Clients served at a time."),
    option<&PublishSettings::client_queue>("client_queue", "lines", 8, 65536,
                                           "Lines kept for a slow client; the oldest poses are lost first."),
};

inline constexpr std::array<std::string_view, 5> log_levels{"debug", "info", "warning", "error", "off"};

struct LogSettings {
    std::string level = "info";
};

inline constexpr std::array log_options{
    option<&LogSettings::level>("level", "Least serious message that is written.", log_levels),
};

struct RealtimeSettings {
    int priority = 50;
    bool lock_memory = true;
    double spin_s = 0;
};

inline constexpr std::array realtime_options{
    option<&RealtimeSettings::priority>(
        "priority", "", 0, 98,
        "SCHED_FIFO priority of the fusion thread where allowed, inputs and publisher one below; 0: all ordinary."),
    option<&RealtimeSettings::lock_memory>("lock_memory", "Whether memory is locked where allowed."),
    option<&RealtimeSettings::spin_s>("spin_s", "s", 0, 0.001, "Last part of each wait that is spun, not slept."),
};

struct Settings {
    EngineSettings engine;
    std::vector<InputSettings> inputs;
    std::vector<CameraInputSettings> cameras; ///< engine.cameras is their number
    PublishSettings publish;
    NmeaOutputSettings nmea;
    LogSettings log;
    RealtimeSettings realtime;
};

} // namespace locus
