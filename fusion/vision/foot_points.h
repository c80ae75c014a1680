// Foot points of cameras: they come one by one and without names. Those of one image are gathered, put beside the tags
// (naming.h) and handed on, each to the target whose feet they are.
//
// An image is dealt with at the first tick that lies gather_s after its first foot point came, or when one of a newer
// image comes.
#pragma once

#include "fusion/aid_book.h"
#include "fusion/vision/anonymous.h"
#include "fusion/vision/look_book.h"
#include "fusion/vision/settings.h"

#include <memory>
#include <span>
#include <vector>

namespace locus::vision {

/// Whose feet they are, as far as is known.
struct FeetOwner {
    Address target = no_address;
    double confidence = 0; ///< 0: a target without a tag
};

class FootPoints {
  public:
    class Output {
      public:
        virtual ~Output() = default;
        /// Where the tags were at `time` by all but what cameras saw, so that no name proves itself.
        virtual std::span<const LocatedTag> locate(Timestamp time) noexcept = 0;
        /// A foot point for its target, to be judged by whoever takes it.
        virtual void give(const Measurement& foot, const AidBook::Record& record, const FeetOwner& owner) noexcept = 0;
        /// The last word on a foot point.
        virtual void judge(const Measurement& foot, const AidBook::Record& record, Exclusion reason) noexcept = 0;
    };

    /// `rest`: how long a target that was given up is left alone.
    FootPoints(const VisionSettings& settings, std::size_t cameras, std::size_t max_tags, Duration longest_wait,
               Duration rest);

    /// A FootPoint. none: kept, and Output will hear of it.
    Exclusion hear(const Measurement& measurement, const AidBook::Record& record, Timestamp arrival,
                   Output& output) noexcept;

    /// Deals with every image whose time has come.
    void run(Timestamp tick, Output& output) noexcept;

  private:
    struct HeardFoot {
        Measurement measurement; ///< of a FootPoint
        AidBook::Record record;
        const FootPoint& foot() const { return *std::get_if<FootPoint>(&measurement.observation); }
    };
    /// What a camera sees at one moment, and what is known of the people in it from before.
    struct Image {
        Image(const VisionSettings& settings, std::size_t max_tags, CameraLooks looks, Duration rest);
        std::unique_ptr<Naming> naming;
        AnonymousTargets strangers;
        Timestamp time = Timestamp::min(); ///< of the feet in it, or of the last that were dealt with
        Timestamp first_arrival{};
        std::vector<HeardFoot> feet; ///< empty: dealt with
    };

    void deal(Image& image, Output& output) noexcept;
    void hand_on(Image& image, const HeardFoot& heard, const Named& named, Output& output) const noexcept;

    VisionSettings settings_;
    Duration gather_;
    std::unique_ptr<LookBook> looks_;
    std::vector<Image> images_; ///< the newest of each camera, by its address
    std::vector<SeenPerson> people_;
};

} // namespace locus::vision
