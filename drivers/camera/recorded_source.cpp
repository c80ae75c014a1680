#include "drivers/camera/recorded_source.h"

#include "drivers/camera/mat.h"
#include "drivers/clock.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace locus::camera {
namespace {

constexpr double folder_rate_hz = 10;

/// Pictures one after the other, whatever they are kept in.
class PictureSequence {
  public:
    virtual ~PictureSequence() = default;
    virtual bool open() = 0;
    /// False at the end.
    virtual bool read(cv::Mat& picture) = 0;
    virtual double rate_hz() const { return folder_rate_hz; }
};

class VideoFile : public PictureSequence {
  public:
    explicit VideoFile(std::string path) : path_{std::move(path)} {}
    bool open() override { return video_.open(path_, cv::CAP_FFMPEG); }
    bool read(cv::Mat& picture) override { return video_.read(picture); }
    double rate_hz() const override { return video_.get(cv::CAP_PROP_FPS); }

  private:
    const std::string path_;
    cv::VideoCapture video_;
};

class ImageFolder : public PictureSequence {
  public:
    explicit ImageFolder(std::string path) : path_{std::move(path)} {}

    bool open() override {
        files_.clear();
        next_ = 0;
        std::error_code failed;
        for (const auto& entry : std::filesystem::directory_iterator{path_, failed})
            if (cv::haveImageReader(entry.path())) files_.push_back(entry.path());
        std::sort(files_.begin(), files_.end());
        return !files_.empty();
    }

    bool read(cv::Mat& picture) override {
        if (next_ == files_.size()) return false;
        try {
            picture = cv::imread(files_[next_++], cv::IMREAD_COLOR);
        } catch (const cv::Exception&) { // larger than OpenCV believes
            picture.release();           // as damaged images are empty: that is one frame less, not the end
        }
        return true;
    }

  private:
    const std::string path_;
    std::vector<std::string> files_;
    std::size_t next_ = 0;
};

class RecordedSource : public FrameSource {
  public:
    RecordedSource(RecordedSettings settings, std::optional<Timestamp> start)
        : settings_{std::move(settings)}, wanted_start_{start} {}

    bool open() override {
        std::error_code ignored;
        const bool is_folder = std::filesystem::is_directory(settings_.path, ignored);
        if (!std::filesystem::exists(settings_.path, ignored)) return refuse("is not there");
        if (is_folder)
            pictures_ = std::make_unique<ImageFolder>(settings_.path);
        else
            pictures_ = std::make_unique<VideoFile>(settings_.path);
        if (!pictures_->open()) return refuse(is_folder ? "holds no image" : "is no video that this machine can read");
        start_ = wanted_start_.value_or(monotonic_now());
        began_ = monotonic_now();
        count_ = 0;
        return set_interval();
    }
    void close() override { pictures_.reset(); }

    FrameStatus next(Frame& frame, Duration timeout) override {
        if (settings_.speed > 0 && !wait_for_next(timeout)) return FrameStatus::nothing;
        if (!read()) return FrameStatus::ended;
        while (settings_.speed > 0 && time_to(count_ + 1) < Duration{0} && read()) { // as of a camera: only the newest
            ++count_;
            ++dropped_;
        }
        frame.captured = start_ + static_cast<std::int64_t>(count_) * interval_;
        frame.sequence = count_++;
        if (!copy(frame.picture)) {
            ++damaged_;
            return FrameStatus::nothing;
        }
        return FrameStatus::frame;
    }

    std::uint64_t dropped() const override { return dropped_; }
    std::uint64_t damaged() const override { return damaged_; }
    std::string_view last_error() const override { return error_; }

  private:
    bool refuse(const std::string& what) {
        error_ = "'" + settings_.path + "' " + what;
        return false;
    }

    bool set_interval() {
        const double rate_hz = settings_.rate_hz > 0 ? settings_.rate_hz : pictures_->rate_hz();
        if (!(rate_hz > 0.001 && rate_hz < 10'000))
            return refuse("does not say how many frames a second it has: set rate_hz");
        interval_ = duration_from_s(1 / rate_hz);
        return true;
    }

    /// Until that frame is due; negative: it was due before now.
    Duration time_to(std::uint64_t frame) const {
        const double due_s = to_s(static_cast<std::int64_t>(frame) * interval_) / settings_.speed;
        return began_ + duration_from_s(due_s) - monotonic_now();
    }

    /// False: not yet within this time.
    bool wait_for_next(Duration timeout) const {
        const Duration left = time_to(count_);
        if (left > Duration{0}) std::this_thread::sleep_for(std::min(left, timeout));
        return left <= timeout;
    }

    bool read() {
        if (pictures_->read(decoded_)) return true;
        return settings_.loop && count_ > 0 && pictures_->open() && pictures_->read(decoded_);
    }

    bool copy(Picture& picture) const {
        if (decoded_.empty() || decoded_.type() != CV_8UC3 || std::max(decoded_.cols, decoded_.rows) > max_side_px)
            return false;
        picture.resize(decoded_.cols, decoded_.rows, 3);
        cv::Mat to = as_mat(picture);
        decoded_.copyTo(to);
        return true;
    }

    const RecordedSettings settings_;
    const std::optional<Timestamp> wanted_start_;
    std::unique_ptr<PictureSequence> pictures_;
    cv::Mat decoded_;
    Duration interval_{0};
    Timestamp start_; ///< stamp of the first frame
    Timestamp began_; ///< when it was given
    std::uint64_t count_ = 0;
    std::uint64_t dropped_ = 0;
    std::uint64_t damaged_ = 0;
    std::string error_;
};

} // namespace

std::unique_ptr<FrameSource> make_recorded_source(const RecordedSettings& settings, std::optional<Timestamp> start) {
    return std::make_unique<RecordedSource>(settings, start);
}

} // namespace locus::camera
