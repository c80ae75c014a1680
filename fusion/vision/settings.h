// What can be set of the engine's part of vision: whose feet the cameras see. Where the defaults come from: identity.h,
// association_matrix.h;
// gather_s: a camera's thread hands the feet of one image over within microseconds, so this is one tick and a margin;
// a name below least_confidence is more likely wrong than right.
#pragma once

#include "fusion/vision/association_matrix.h"
#include "fusion/vision/identity.h"

#include <string>
#include <string_view>

namespace locus {

struct VisionSettings : vision::IdentitySettings, vision::AssociationSettings {
    std::string association = "hungarian";
    double gather_s = 0.01;
    double least_confidence = 0.5;
    bool anonymous = false;
    int max_anonymous = 16;
};

inline constexpr std::array<std::string_view, 2> association_names{"hungarian", "matrix"};

inline constexpr auto vision_options = joined(
    joined(std::array{option<&VisionSettings::association>(
               "association",
               "Who says whose feet they are: the least total distance of tracks and tags, or "
               "the association matrix of who was near and looked alike.",
               association_names)},
           joined(vision::identity_options<VisionSettings>, vision::association_options<VisionSettings>)),
    std::array{
        option<&VisionSettings::gather_s>("gather_s", "s", 0, 1,
                                          "How long after its first foot point an image is waited for to be "
                                          "complete; never longer than fusion.window_s allows."),
        option<&VisionSettings::least_confidence>("least_confidence", "", 0, 1,
                                                  "A tag gets foot points of a track that is so surely its."),
        option<&VisionSettings::anonymous>("anonymous", "Whether people without a tag are targets of their own."),
        option<&VisionSettings::max_anonymous>("max_anonymous", "", 0, 64,
                                               "How many of them at a time, for each camera; each takes a place "
                                               "of fusion.max_targets."),
    });

} // namespace locus
