// What moves: background subtraction with shadows taken out (MOG2: Zivkovic 2004, "Improved adaptive Gaussian mixture
// model for background subtraction"; shadows: Prati et al. 2003). For .cpp files of this room only.
#pragma once

#include <opencv2/video/background_segm.hpp>

namespace locus::camera {

/// Defaults are the authors' own, as OpenCV has them.
struct ForegroundSettings {
    int history_frames = 500;
    double threshold_sigma = 4;
    double darkest_shadow = 0.5;
    bool remove_shadows = true;
};

class Foreground {
  public:
    explicit Foreground(const ForegroundSettings& settings);

    /// 255 where something moves, 0 elsewhere; valid until the next call. Specks are gone, small holes closed.
    const cv::Mat& take(const cv::Mat& picture);

  private:
    cv::Ptr<cv::BackgroundSubtractorMOG2> model_;
    cv::Mat smooth_;
    cv::Mat mask_;
};

} // namespace locus::camera
