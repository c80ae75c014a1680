// What every detector has to be told, and what is done with whatever it finds.
#pragma once

#include "drivers/camera/detector.h"
#include "drivers/camera/region.h"

#include <array>
#include <string>

namespace locus::camera {

/// Smallest: where "medium" ends and "far" begins, where nobody finds people (Dollar et al. 2012, section 2.2.1).
struct PeopleSettings {
    double least_height_px = 30;
    double most_height_px = 4000;
    std::string region;
    bool looks = true;
};

template <class Settings>
inline constexpr std::array people_options{
    option<&PeopleSettings::least_height_px, Settings>("least_height_px", "px", 16, 2000,
                                                       "Whoever is smaller is left out."),
    option<&PeopleSettings::most_height_px, Settings>("most_height_px", "px", 16, 8192, "Larger ones are nobody."),
    option<&PeopleSettings::region, Settings>(
        "region", "Where feet may be: corners \"x,y x,y x,y\" in shares of width and height; empty: everywhere."),
    option<&PeopleSettings::looks, Settings>("looks", "Whether people's colours are described, for the tracker."),
};

template <class Settings>
std::string check_people(const void* settings) {
    const PeopleSettings& people = *static_cast<const Settings*>(settings);
    if (Region::parse(people.region)) return {};
    return "region '" + people.region + "' is no list of at least three corners \"x,y x,y x,y\" within 0..1";
}

/// Leaves those of a possible size in the region, the surest first, and describes their looks.
class Sorting {
  public:
    explicit Sorting(const PeopleSettings& settings);
    std::vector<vision::Detection> sort(const Picture& picture, std::vector<vision::Detection> found) const;

  private:
    PeopleSettings settings_;
    Region region_;
};

} // namespace locus::camera
