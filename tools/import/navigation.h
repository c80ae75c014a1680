// A navigation file of RINEX: what it says becomes the words of the satellites, at the time of their broadcast.
#pragma once

#include "drivers/gnss/rinex_navigation.h"
#include "tools/import/source.h"

namespace locus::importing {

class NavigationFile final : public Source {
  public:
    /// Reads all of it.
    NavigationFile(const std::string& path, Address tag);

    GlonassSlots glonass_slots() const;

    /// There are observations from then on. Satellites repeat what they say, so what each said last in the half day
    /// before comes then, and what is older is left out. (GLONASS tells the time of day only: an older reference time
    /// would be taken for one of the wrong day.)
    void begin_at(Timestamp begin);

    /// All at once, in order of time.
    bool read(std::vector<Item>& items) override;

  private:
    struct Record {
        Timestamp sent;
        gnss::rinex::NavigationRecord printed;
    };

    Address tag_;
    std::vector<Record> records_; ///< in order of `sent`
    std::optional<gnss::Klobuchar> ionosphere_;

    void add(const std::optional<gnss::rinex::NavigationRecord>& printed);
    void read_ionosphere(std::vector<Item>& items);
};

} // namespace locus::importing
