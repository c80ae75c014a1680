// Poses of a SLAM as it saved them (TUM trajectories): dated by their own stamps, segments as decoder `tum` sees them.
#include "drivers/slam/tum.h"
#include "tools/import/lines.h"
#include "tools/import/source.h"

namespace locus::importing {
namespace {

class TumSource final : public Source {
  public:
    TumSource(const std::string& path, const slam::TumSettings& settings, double shift_s)
        : lines_{path}, shift_{duration_from_s(shift_s)} {
        slam::TumSettings by_stamp = settings;
        by_stamp.stamps = "arrival"; // each line comes at its own stamp
        decoder_ = slam::make_tum(&by_stamp);
        report_.clock = "the poses' clock";
    }

    bool read(std::vector<Item>& items) override {
        std::string_view line;
        if (!lines_.next(line)) return false;
        const auto pose = slam::parse_tum_pose(line);
        if (pose && slam::is_usable(*pose)) packet_.time = timestamp_from_s(pose->time_s) + shift_;
        const std::string text = std::string(line) + '\n';
        packet_.data = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
        ListSink sink{items, report_};
        decoder_->decode(packet_, sink);
        return true;
    }

  private:
    Lines lines_;
    Duration shift_;
    std::unique_ptr<Decoder> decoder_;
    Packet packet_;
};

} // namespace

std::unique_ptr<Source> open_tum_poses(const std::string& path, const slam::TumSettings& settings, double shift_s) {
    return std::make_unique<TumSource>(path, settings, shift_s);
}

} // namespace locus::importing
