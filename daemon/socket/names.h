// Names that people gave in the settings, for the addresses that devices use. Made anew for every configuration.
#pragma once

#include "config/settings.h"
#include "fusion/aid_status.h"

#include <map>
#include <string>
#include <utility>

namespace locus {

/// "0x1234".
std::string address_text(Address address);

class Names {
  public:
    Names() = default;
    explicit Names(const Settings& settings);

    /// Configured name, else the address in hexadecimal, as Engine::target_name gives it.
    std::string target(Address address) const;
    /// The same for an anchor or a camera; other kinds of source have no names of their own yet.
    std::string source(SourceKind kind, Address address) const;

  private:
    std::map<Address, std::string> targets_;
    std::map<Address, std::string> anchors_;
    std::map<Address, std::string> cameras_;
};

} // namespace locus
