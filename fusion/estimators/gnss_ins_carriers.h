// The carriers of two epochs of one receiver: the one whose satellites are being heard, and the one before it, at whose
// place the track holds itself. Fixed in size.
#pragma once

#include "fusion/gnss/carrier_change.h"
#include "fusion/time.h"

#include <algorithm>
#include <array>
#include <span>

namespace locus {

class GnssInsCarriers {
  public:
    /// Satellites of one epoch; those beyond go without their carrier.
    static constexpr std::size_t room = 48;

    void hear(const gnss::CarrierSight& sight, Timestamp time) noexcept {
        now_.time = time;
        gnss::CarrierSight* const same = now_.find(sight);
        if (same != nullptr)
            *same = sight;
        else if (now_.count < room)
            now_.sights[now_.count++] = sight;
    }
    /// There are some that wait for the end of their epoch.
    bool is_waiting() const noexcept { return now_.count > 0; }
    std::span<gnss::CarrierSight> waiting() noexcept { return std::span(now_.sights).first(now_.count); }
    /// nullptr: not heard at the epoch before.
    const gnss::CarrierSight* before(const gnss::CarrierSight& of) const noexcept { return before_.find(of); }
    bool has_before() const noexcept { return before_.count > 0; }
    double since_before_s() const noexcept { return to_s(now_.time - before_.time); }

    /// What waited is the epoch before.
    void turn_over() noexcept {
        before_ = now_;
        now_.count = 0;
    }
    void forget() noexcept { before_.count = now_.count = 0; }

  private:
    struct Epoch {
        Timestamp time{};
        std::size_t count = 0;
        std::array<gnss::CarrierSight, room> sights{};

        template <class Self>
        static auto* find_in(Self& self, const gnss::CarrierSight& of) noexcept {
            const auto end = self.sights.begin() + static_cast<std::ptrdiff_t>(self.count);
            const auto found = std::find_if(self.sights.begin(), end, [&](const gnss::CarrierSight& one) {
                return one.constellation == of.constellation && one.satellite == of.satellite;
            });
            return found == end ? nullptr : &*found;
        }
        gnss::CarrierSight* find(const gnss::CarrierSight& of) noexcept { return find_in(*this, of); }
        const gnss::CarrierSight* find(const gnss::CarrierSight& of) const noexcept { return find_in(*this, of); }
    };
    Epoch before_, now_;
};

} // namespace locus
