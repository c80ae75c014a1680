// What the publisher knows of the configuration in force. Made by the main thread, handed over whole, never changed.
#pragma once

#include "config/settings.h"
#include "daemon/camera/viewfinder.h"
#include "daemon/nmea/output.h"
#include "daemon/output.h"
#include "daemon/socket/names.h"
#include "drivers/input_status.h"

#include <memory>
#include <string>
#include <vector>

namespace locus {

struct InputEntry {
    std::string name;
    std::string transport;
    std::string decoder;
    std::shared_ptr<const InputStatus> status; ///< null: disabled in the settings
    std::shared_ptr<Viewfinder> view{};        ///< null: it is no camera, or disabled
};

struct Roster {
    Generation generation = 0;
    std::string site;
    std::string config;
    double rate_hz = 0;
    std::size_t anchors = 0;
    PublishSettings publish;
    std::optional<NmeaPlan> nmea;
    Names names;
    std::vector<InputEntry> inputs;
    bool memory_locked = false;
    Timestamp started{};
};

} // namespace locus
