// Who may teach the radio map (paper 003 section 5.1): whose radio is heard while a camera sees him, and whose name has
// been sure for a while, and who stands alone. When a camera's track turns out to be somebody else's, what its first
// owner taught is withdrawn: one of the two names was wrong, and nobody knows which.
#pragma once

#include "fusion/measurement.h"
#include "fusion/radio/lesson.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace locus::radio {

class Teachers {
  public:
    /// For so many targets; no allocation after this.
    explicit Teachers(std::size_t targets);

    /// A foot point was given to a target by its tag; `confidence` of 0 is a person without one.
    void see(std::size_t target, const FootPoint& foot, double confidence, Timestamp time) noexcept;
    /// A target's radio was heard.
    void hear(std::size_t target, const Reading& reading, Timestamp time) noexcept;

    /// Those since the last call, at most max_lessons; more are lost, except what is withdrawn. Valid until the next
    /// see() or hear().
    std::span<const Lesson> take() noexcept;

    static constexpr std::size_t max_lessons = 1024;
    /// Feet this old say no more where the radio is: at walking pace as much as a foot point's own doubt.
    static constexpr double feet_hold_s = 0.5;
    /// Wrong names of people who cross last up to two seconds (docs/cameras.md).
    static constexpr double sure_after_s = 5;
    static constexpr double least_confidence = 0.9;
    /// Bodies so near shade a radio for as long as they stand there; that is not to be learnt.
    static constexpr double alone_m = 2.5;

  private:
    struct Course {
        Address camera = no_address;
        std::uint32_t track = 0;
        std::size_t target = 0;
        std::uint64_t number = 0; ///< 0: a free place
        Timestamp since{}, last{};
    };
    struct Place {
        std::size_t course = no_course; ///< index
        Timestamp time{};
        std::array<double, 2> position_site_m{};
    };
    static constexpr std::size_t no_course = static_cast<std::size_t>(-1);
    /// Of the past; beyond it the longest unseen is forgotten, and stays taught.
    static constexpr std::size_t max_courses = 256;

    std::size_t course_of(std::size_t target, const FootPoint& foot, Timestamp time) noexcept;
    void begin(Course& course, std::size_t target, const FootPoint& foot, Timestamp time) noexcept;
    bool is_alone(std::size_t target, Timestamp time) const noexcept;
    void push(const Lesson& lesson) noexcept;

    std::vector<Course> courses_;
    std::vector<Place> places_;   ///< of the feet of each target
    std::size_t place_count_ = 0; ///< the first so many are of targets that were ever seen
    std::vector<Lesson> lessons_;
    std::uint64_t last_number_ = 0;
    bool was_taken_ = false;
};

} // namespace locus::radio
