// Targets for people without a tag: each camera has a few places, and each place is a target with an address that no
// device has. A place is given to the next track only when its target has been given up, so nobody inherits a past.
#pragma once

#include "fusion/measurement.h"

#include <optional>
#include <string>
#include <vector>

namespace locus::vision {

/// No EUI-64 begins like this: FF:FF:FF:FE is of nobody.
Address anonymous_address(Address camera, std::size_t place) noexcept;
bool is_anonymous(Address target) noexcept;

/// "anonymous-2-7": seventh place of the second camera. `text` has room for it.
void write_anonymous_name(std::string& text, Address target) noexcept;

class AnonymousTargets {
  public:
    /// A place rests for `rest` after its track was last seen.
    AnonymousTargets(std::size_t places, Duration rest) : rest_(rest), places_(places) {}

    /// Empty: no place is free.
    std::optional<Address> target_of(Address camera, std::uint32_t track, Timestamp time) noexcept;

  private:
    struct Place {
        std::uint32_t track = 0;
        std::optional<Timestamp> seen{};
    };

    Duration rest_;
    std::vector<Place> places_;
};

} // namespace locus::vision
