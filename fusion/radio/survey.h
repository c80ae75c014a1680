// A radio map collected on foot: readings with the place they were heard at, gathered in cells of the floor.
#pragma once

#include "fusion/radio/radio_map.h"

#include <map>
#include <utility>

namespace locus::radio {

class Survey {
  public:
    /// One reference point for each cell of this width in which anything was heard.
    explicit Survey(double cell_m) : cell_m_(cell_m) {}

    void add(const Reading& reading, const Vec3& position_site_m);

    /// A point for each cell: the mean place of its readings, and of each beacon mean, spread and number. Readings of
    /// strengths that no radio hears were left out.
    RadioMap map() const;
    std::size_t cells() const { return cells_.size(); }

  private:
    struct Gathered {
        int count = 0;
        double mean_dbm = 0, squares_db2 = 0;
    };
    struct Cell {
        int count = 0;
        Vec3 sum_m{};
        std::map<Address, Gathered> heard;
    };

    double cell_m_;
    std::map<std::pair<long, long>, Cell> cells_;
};

} // namespace locus::radio
