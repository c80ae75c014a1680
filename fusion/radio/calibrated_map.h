// A radio map that calibrates itself (paper 003 section 5.1): who is seen by a camera and heard by radio shows how
// strong the beacons are there now, with the people and the furniture of the day. Each reference point near by is moved
// towards what was heard. A wrong identity cannot poison it for long: no strength is moved further from the surveyed
// one than a bound, and what somebody taught can be taken back when the name turns out wrong.
#pragma once

#include "fusion/radio/lesson.h"
#include "fusion/radio/radio_map.h"

#include <Eigen/Core>

#include <cstdint>
#include <deque>
#include <span>

namespace locus::radio {

struct CalibrationSettings {
    /// Of what is off, taken over at once by a point right there: what stays is to be learnt and not what passes, so a
    /// visit of some seconds must not outweigh the survey.
    double gain = 0.05;
    double reach_m = 1.5;        ///< over which that falls by e^-1/2
    double most_db = 15;         ///< from the surveyed strength
    std::size_t memory = 200000; ///< lessons that can be taken back
};

class CalibratedMap {
  public:
    CalibratedMap(RadioMap surveyed, const CalibrationSettings& settings)
        : surveyed_(std::move(surveyed)), now_(surveyed_), settings_(settings) {}
    /// Goes on from what was taught before. Throws std::invalid_argument when `taught` is not made of this survey.
    CalibratedMap(RadioMap surveyed, RadioMap taught, const CalibrationSettings& settings);

    const RadioMap& map() const { return now_; }
    /// Mean of how far strengths have been moved, in dB.
    double moved_db() const;

    /// `teacher` was seen at `position_site_m` and heard this. Only beacons that a point heard in the survey are
    /// taught.
    void learn(std::uint64_t teacher, const Eigen::Vector2d& position_site_m, std::span<const Reading> heard);
    /// What a lesson says: one of the two.
    void heed(const Lesson& lesson);
    /// Undoes what is remembered of this one's lessons.
    void take_back(std::uint64_t teacher);

  private:
    struct Taught {
        std::uint64_t teacher;
        std::size_t point, strength; ///< indices
        double moved_db;
    };
    void move(std::size_t point, std::size_t strength, double wanted_db, std::uint64_t teacher);

    RadioMap surveyed_, now_;
    CalibrationSettings settings_;
    std::deque<Taught> lessons_;
};

/// Whether both have the same points and, at each, the same beacons.
bool is_of_survey(const RadioMap& surveyed, const RadioMap& taught);

} // namespace locus::radio
