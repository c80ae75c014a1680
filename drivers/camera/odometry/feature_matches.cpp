#include "drivers/camera/odometry/feature_matches.h"

#include <opencv2/flann/miniflann.hpp>

#include <limits>

namespace locus::camera {
namespace {

/// Twelve tables of twenty bits, neighbouring buckets searched as well: the figures of OpenCV's own examples for ORB.
constexpr int tables = 12, key_bits = 20, probes = 2;
constexpr float second_match = 0.8F; // Lowe 2004, fig. 11
/// Of 256 bits: two descriptors of different places differ by half of them, give or take (Rublee 2011, fig. 4).
constexpr float most_different_match = 64;

cv::Mat as_rows(std::span<const Descriptor> descriptors) {
    auto* bytes = const_cast<Descriptor*>(descriptors.data()); // NOLINT(*-const-cast): OpenCV knows no constant view
    return {static_cast<int>(descriptors.size()), static_cast<int>(sizeof(Descriptor)), CV_8U, bytes};
}

} // namespace

std::vector<Descriptor> descriptors_of(const Features& features) {
    std::vector<Descriptor> descriptors(features.size());
    for (std::size_t i = 0; i < features.size(); ++i) descriptors[i] = features[i].descriptor;
    return descriptors;
}

std::vector<FeatureMatch> match_features(std::span<const Descriptor> first, std::span<const Descriptor> second) {
    if (first.empty() || second.size() < 2) return {};
    cv::theRNG().state = 1; // FLANN draws its bits from it: the same pictures, the same pairs
    const cv::FlannBasedMatcher flann(cv::makePtr<cv::flann::LshIndexParams>(tables, key_bits, probes));
    std::vector<std::vector<cv::DMatch>> found;
    flann.knnMatch(as_rows(first), as_rows(second), found, 2);
    constexpr auto nobody = std::numeric_limits<std::size_t>::max();
    std::vector<std::pair<std::size_t, float>> chosen(second.size(), {nobody, most_different_match});
    for (const auto& choices : found) {
        if (choices.empty()) continue;
        if (choices.size() > 1 && choices[0].distance > second_match * choices[1].distance) continue;
        auto& holder = chosen[static_cast<std::size_t>(choices[0].trainIdx)];
        if (choices[0].distance < holder.second)
            holder = {static_cast<std::size_t>(choices[0].queryIdx), choices[0].distance};
    }
    std::vector<FeatureMatch> matches;
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (chosen[i].first != nobody) matches.emplace_back(chosen[i].first, i);
    return matches;
}

} // namespace locus::camera
