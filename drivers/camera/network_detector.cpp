// People by a network of the YOLO family, in ONNX or Darknet's format. The weights are the user's own file.
#include "drivers/camera/detector_rows.h"
#include "drivers/camera/mat.h"
#include "drivers/camera/people_settings.h"
#include "drivers/camera/suppress.h"
#include "drivers/camera/yolo_head.h"

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>

namespace locus::camera {
namespace {

/// Scores and overlap as the networks' own programs have them.
struct NetworkSettings : PeopleSettings {
    std::string model;
    std::string darknet_config;
    int input_px = 640;
    std::string head = "auto";
    int person_class = 0;
    double least_score = 0.25;
    double most_iou = 0.45;
};

constexpr auto network_options = joined(
    people_options<NetworkSettings>,
    std::array{
        required_option<&NetworkSettings::model>("model", "File of the network: .onnx, or Darknet's .weights."),
        option<&NetworkSettings::darknet_config>("darknet_config", "Darknet's .cfg; empty for ONNX."),
        option<&NetworkSettings::input_px>("input_px", "px", 32, 4096, "Side of the square that the network takes."),
        option<&NetworkSettings::head>(
            "head", "How its output is read: v3 (Darknet), v5 (also v6, v7), v8 (also v9, v11).", yolo_head_names),
        option<&NetworkSettings::person_class>("person_class", "", 0, 10'000,
                                               "Number of the class of people; 0 in COCO."),
        option<&NetworkSettings::least_score>("least_score", "", 0, 1, "Who scores less is left out."),
        option<&NetworkSettings::most_iou>("most_iou", "", 0, 1,
                                           "Overlap (intersection over union) of two people's boxes at most."),
    });

/// The first line of what OpenCV says, without its own source file.
std::string reason(const cv::Exception& problem) { return problem.err.substr(0, problem.err.find('\n')); }

/// A picture shrunk or enlarged into the network's square, the rest of it grey (as YOLO's own programs do).
struct Letterbox {
    cv::Mat square;
    double factor = 1;
    cv::Point offset;
};

Letterbox letterbox(const cv::Mat& picture, int side_px) {
    Letterbox box;
    box.square = cv::Mat{side_px, side_px, CV_8UC3, cv::Scalar::all(114)};
    box.factor = static_cast<double>(side_px) / std::max(picture.cols, picture.rows);
    const cv::Size size{std::max(1, static_cast<int>(picture.cols * box.factor)),
                        std::max(1, static_cast<int>(picture.rows * box.factor))};
    box.offset = {(side_px - size.width) / 2, (side_px - size.height) / 2};
    cv::Mat colour = picture;
    if (picture.channels() == 1) cv::cvtColor(picture, colour, cv::COLOR_GRAY2BGR);
    cv::resize(colour, box.square({box.offset, size}), size, 0, 0, cv::INTER_LINEAR);
    return box;
}

vision::BoxPx in_picture(const vision::BoxPx& box, const Letterbox& from) {
    const auto back = static_cast<float>(1 / from.factor);
    return {(box.left_px - static_cast<float>(from.offset.x)) * back,
            (box.top_px - static_cast<float>(from.offset.y)) * back, box.width_px * back, box.height_px * back};
}

class NetworkDetector : public Detector {
  public:
    explicit NetworkDetector(const NetworkSettings& settings)
        : settings_{settings}, head_{settings.head, settings.person_class, settings.least_score}, sorting_{settings} {}

    /// Loads the network and runs it once on nothing; a sentence when it cannot be used, else empty.
    std::string load() {
        for (const std::string& file : {settings_.model, settings_.darknet_config})
            if (!file.empty() && !std::filesystem::is_regular_file(file)) return "'" + file + "' is not there";
        try {
            network_ = settings_.darknet_config.empty()
                           ? cv::dnn::readNetFromONNX(settings_.model)
                           : cv::dnn::readNetFromDarknet(settings_.darknet_config, settings_.model);
        } catch (const cv::Exception& problem) {
            return "'" + settings_.model + "' is no network that OpenCV can read: " + reason(problem);
        }
        return try_out();
    }

    std::vector<vision::Detection> detect(const Picture& picture) override {
        const Letterbox input = letterbox(as_mat(picture), settings_.input_px);
        std::vector<vision::Detection> people;
        run(input.square, people);
        for (auto& person : people) person.box = in_picture(person.box, input);
        return sorting_.sort(picture, suppress(std::move(people), static_cast<float>(settings_.most_iou)));
    }

  private:
    std::string try_out() {
        const std::string model = "'" + settings_.model + "' ";
        try {
            std::vector<vision::Detection> nobody;
            const cv::Mat nothing(settings_.input_px, settings_.input_px, CV_8UC3, cv::Scalar::all(0));
            const std::string misfit = run(nothing, nobody);
            return misfit.empty() ? misfit : model + "cannot be used: " + misfit + "; set head or person_class";
        } catch (const cv::Exception& problem) {
            const std::string side = std::to_string(settings_.input_px);
            return model + "does not take pictures of " + side + "x" + side +
                   ": set input_px to the size that it was made for (" + reason(problem) + ")";
        }
    }

    std::string run(const cv::Mat& square, std::vector<vision::Detection>& people) {
        network_.setInput(cv::dnn::blobFromImage(square, 1 / 255., {}, {}, true));
        std::vector<cv::Mat> outputs;
        network_.forward(outputs, network_.getUnconnectedOutLayersNames());
        for (const cv::Mat& output : outputs)
            if (auto misfit = decode(output, head_, square.size(), people); !misfit.empty()) return misfit;
        return outputs.empty() ? "it puts nothing out" : std::string{};
    }

    const NetworkSettings settings_;
    const YoloHead head_;
    const Sorting sorting_;
    cv::dnn::Net network_;
};

} // namespace

DetectorRow network_row() {
    return {"network", "A network of the YOLO family, from a file of yours: finds most and costs most.",
            option_table<NetworkSettings>(network_options, {}, check_people<NetworkSettings>),
            [](const void* settings, const ExpectedHeight&, std::string& error) -> std::unique_ptr<Detector> {
                auto detector = std::make_unique<NetworkDetector>(*static_cast<const NetworkSettings*>(settings));
                error = detector->load();
                return error.empty() ? std::move(detector) : nullptr;
            }};
}

} // namespace locus::camera
