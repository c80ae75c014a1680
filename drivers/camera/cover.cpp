#include "drivers/camera/cover.h"

#include "drivers/camera/person_shape.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace locus::camera {
namespace {

cv::Rect to_rect(const vision::BoxPx& box, const cv::Size& image) {
    const auto left = static_cast<int>(std::lround(box.left_px));
    const auto top = static_cast<int>(std::lround(box.top_px));
    const auto right = static_cast<int>(std::lround(box.right_px()));
    const auto bottom = static_cast<int>(std::lround(box.bottom_px()));
    return cv::Rect{left, top, std::max(right - left, 1), std::max(bottom - top, 1)} & cv::Rect{{0, 0}, image};
}

int sum_in(const cv::Mat& integral, const cv::Rect& rect) {
    return integral.at<int>(rect.br()) - integral.at<int>(rect.y, rect.br().x) - integral.at<int>(rect.br().y, rect.x) +
           integral.at<int>(rect.tl());
}

/// What is left to explain, with sums over rectangles at once (Viola and Jones 2001).
class Unexplained {
  public:
    Unexplained(const cv::Mat& foreground, const std::vector<vision::Detection>& known)
        : foreground_{foreground.clone()}, open_(foreground.size(), CV_8UC1, cv::Scalar(1)) {
        for (const auto& person : known) clear(to_rect(person.box, size()));
        add_up();
    }
    int moving(const cv::Rect& rect) const { return sum_in(moving_sums_, rect); }
    int open(const cv::Rect& rect) const { return sum_in(open_sums_, rect); }
    void explain(const cv::Rect& rect) {
        clear(rect);
        add_up();
    }
    cv::Size size() const { return foreground_.size(); }
    const cv::Mat& foreground() const { return foreground_; }

  private:
    void clear(const cv::Rect& rect) {
        foreground_(rect).setTo(0);
        open_(rect).setTo(0);
    }
    void add_up() {
        cv::integral(foreground_ / 255, moving_sums_, CV_32S);
        cv::integral(open_, open_sums_, CV_32S);
    }
    cv::Mat foreground_;
    cv::Mat open_; ///< 1 where no box was laid yet
    cv::Mat moving_sums_, open_sums_;
};

struct Candidate {
    vision::BoxPx box;
    cv::Rect rect; ///< what of it is inside the image
    double gain = 0;
    double filled = 0;
};

/// Positive when the box is filled enough, and the larger the more it explains; 0 of a box that is not worth it.
Candidate weigh(const Unexplained& rest, const vision::BoxPx& box, const CoverSettings& settings) {
    Candidate candidate{.box = box, .rect = to_rect(box, rest.size())};
    const double area = static_cast<double>(box.width_px) * box.height_px;
    if (candidate.rect.empty() || candidate.rect.area() < 0.5 * area) return candidate;
    const double moving = rest.moving(candidate.rect);
    const double open = rest.open(candidate.rect);
    if (moving < settings.least_visible * area) return candidate;
    candidate.filled = moving / open;
    candidate.gain = (moving - settings.least_filled * open) / area;
    return candidate;
}

std::vector<Candidate> candidates(const Unexplained& rest, const std::vector<vision::BoxPx>& places,
                                  const CoverSettings& settings) {
    std::vector<Candidate> found;
    for (const vision::BoxPx& box : places) {
        const Candidate candidate = weigh(rest, box, settings);
        if (candidate.gain > 0) found.push_back(candidate);
    }
    return found;
}

/// The box drawn in to what moves inside it, where that still is a whole person: feet and head are where they are seen.
vision::BoxPx drawn_in(const cv::Mat& foreground, const Candidate& candidate) {
    const cv::Rect inside = cv::boundingRect(foreground(candidate.rect));
    const cv::Rect tight = inside + candidate.rect.tl();
    const bool is_whole = static_cast<float>(tight.height) >= least_of_expected * candidate.box.height_px;
    if (!is_whole) return candidate.box;
    const float middle_px = static_cast<float>(tight.x) + 0.5F * static_cast<float>(tight.width);
    const float bottom_px = static_cast<float>(tight.br().y);
    return standing_box(middle_px, bottom_px, static_cast<float>(tight.height));
}

} // namespace

std::vector<vision::Detection> cover(const cv::Mat& foreground, const std::vector<vision::BoxPx>& standing,
                                     const CoverSettings& settings, const std::vector<vision::Detection>& known) {
    std::vector<vision::Detection> people;
    Unexplained rest{foreground, known};
    auto places = candidates(rest, standing, settings);
    while (!places.empty()) {
        const auto best = std::max_element(places.begin(), places.end(),
                                           [](const Candidate& a, const Candidate& b) { return a.gain < b.gain; });
        const Candidate taken = *best;
        people.push_back({drawn_in(rest.foreground(), taken), static_cast<float>(taken.filled), {}});
        rest.explain(taken.rect);
        for (Candidate& place : places)
            if (!(place.rect & taken.rect).empty()) place = weigh(rest, place.box, settings);
        std::erase_if(places, [](const Candidate& place) { return place.gain <= 0; });
    }
    return people;
}

BoxShares::BoxShares(const cv::Mat& foreground) { cv::integral(foreground / 255, sums_, CV_32S); }

float BoxShares::of(const vision::BoxPx& box) const {
    const cv::Rect rect = sums_.empty() ? cv::Rect{} : to_rect(box, {sums_.cols - 1, sums_.rows - 1});
    return rect.empty() ? 0 : static_cast<float>(sum_in(sums_, rect)) / static_cast<float>(rect.area());
}

} // namespace locus::camera
