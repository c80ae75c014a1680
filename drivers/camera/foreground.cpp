#include "drivers/camera/foreground.h"

#include <opencv2/imgproc.hpp>

namespace locus::camera {
namespace {

/// The noise of single pixels and of a JPEG's edges is averaged out before it is judged.
constexpr int smoothing_px = 5;
constexpr int speck_px = 3; // noise of pixels stands alone, and neighbours share it through the camera's own filters

} // namespace

Foreground::Foreground(const ForegroundSettings& settings)
    : model_{cv::createBackgroundSubtractorMOG2(
          settings.history_frames, settings.threshold_sigma * settings.threshold_sigma, settings.remove_shadows)} {
    model_->setShadowValue(0);
    model_->setShadowThreshold(settings.darkest_shadow);
}

const cv::Mat& Foreground::take(const cv::Mat& picture) {
    cv::GaussianBlur(picture, smooth_, {smoothing_px, smoothing_px}, 0);
    model_->apply(smooth_, mask_);
    cv::medianBlur(mask_, mask_, speck_px);
    cv::morphologyEx(mask_, mask_, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * speck_px - 1, 2 * speck_px - 1}));
    return mask_;
}

} // namespace locus::camera
