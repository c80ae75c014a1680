// What each tag's wearer looks like in each camera, learnt while his name is sure, and carried from one camera to
// another by a gain for each colour: two cameras show the same coat differently, and by how much is learnt from the
// people whose names were sure in both (paper 003 section 3, after Gilbert and Bowden 2006; theirs is a matrix).
#pragma once

#include "fusion/vision/colours.h"
#include "fusion/vision/tag_numbers.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace locus::vision {

class LookBook {
  public:
    /// No allocation after this. Without cameras it knows nobody.
    LookBook(std::size_t cameras, std::size_t max_tags);

    /// In that camera; where he has not been seen in it, as another one shows him, carried over. Empty: not known.
    std::optional<Colours> colours(std::size_t camera, Address tag) const noexcept;

    /// He was seen so, and it is sure that it was he. Times of one camera rise.
    void learn(std::size_t camera, Address tag, const Colours& seen, Timestamp time) noexcept;

    /// 1: as unlike the tag as others are; -1: as alike as he is to himself; 0: nothing to go by.
    double doubt(std::size_t camera, Address tag, const Colours& seen) const noexcept;

  private:
    using Sum = Eigen::Array<double, Colours::SizeAtCompileTime, 1>;
    struct Memory {
        Colours colours = Colours::Zero();
        double learnt_s = 0;
        Timestamp last = never; ///< never: not known
        bool is_known() const { return last != never; }
    };
    /// Of tags that are known in this camera and in another one.
    struct Shared {
        Sum sum = Sum::Zero(); ///< of their colours in this one
        std::size_t tags = 0;
    };
    /// Usual distances to his own look and to those of others.
    struct Usual {
        double own = 0, others = 0;
        double learnt = 0; ///< images, up to as many as are remembered
    };
    static constexpr Timestamp never = Timestamp::min();

    const Memory* known(std::size_t camera, Address tag) const noexcept;
    Memory& memory(std::size_t camera, std::size_t tag) noexcept { return memories_[camera * max_tags_ + tag]; }
    const Memory& memory(std::size_t camera, std::size_t tag) const noexcept {
        return memories_[camera * max_tags_ + tag];
    }
    Shared& shared(std::size_t first_camera, std::size_t second_camera) noexcept {
        return shared_[first_camera * cameras_ + second_camera];
    }
    const Shared& shared(std::size_t first_camera, std::size_t second_camera) const noexcept {
        return shared_[first_camera * cameras_ + second_camera];
    }
    void tell_apart(std::size_t camera, std::size_t tag, const Colours& seen) noexcept;
    void share(std::size_t camera, std::size_t tag, const Colours& before, bool is_new) noexcept;

    std::size_t cameras_, max_tags_;
    TagNumbers tags_;
    std::vector<Memory> memories_; ///< a row for each camera
    std::vector<Shared> shared_;   ///< a row for each camera
    std::vector<Usual> usual_;     ///< of each camera
};

/// The book as one camera has it open; without a book nobody is known.
class CameraLooks {
  public:
    CameraLooks() = default;
    CameraLooks(LookBook& book, std::size_t camera) : book_(&book), camera_(camera) {}

    std::optional<Colours> colours(Address tag) const noexcept {
        return book_ == nullptr ? std::nullopt : book_->colours(camera_, tag);
    }
    double doubt(Address tag, const Colours& seen) const noexcept {
        return book_ == nullptr ? 0 : book_->doubt(camera_, tag, seen);
    }
    void learn(Address tag, const Colours& seen, Timestamp time) const noexcept {
        if (book_ != nullptr) book_->learn(camera_, tag, seen, time);
    }

  private:
    LookBook* book_ = nullptr;
    std::size_t camera_ = 0;
};

} // namespace locus::vision
