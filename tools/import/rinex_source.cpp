// Observation files of RINEX, an epoch's lines as they come.
#include "drivers/gnss/rinex_observations.h"
#include "tools/import/lines.h"
#include "tools/import/source.h"

namespace locus::importing {
namespace {

class RinexSource final : public Source {
  public:
    RinexSource(const std::string& path, Address tag, GlonassSlots slots) : lines_{path}, observations_{tag} {
        observations_.set_glonass_slots(std::move(slots));
    }

    bool read(std::vector<Item>& items) override {
        std::string_view line;
        std::string error;
        if (!lines_.next(line)) return finish();
        ListSink sink{items, report_};
        observations_.read(line, sink, error);
        note(error);
        return true;
    }

  private:
    Lines lines_;
    gnss::rinex::Observations observations_;

    void note(const std::string& error) {
        if (!error.empty()) report_.problem("line " + std::to_string(lines_.number()) + ": " + error);
    }

    bool finish() {
        std::string error;
        observations_.finish(error);
        note(error);
        const auto& counts = observations_.counts();
        const auto tell = [&](std::uint64_t count, const char* why) {
            if (count > 0) report_.left_out[why] = count;
        };
        tell(counts.without_range, "signals without a pseudorange");
        tell(counts.without_number, "signals that no receiver of u-blox has a number for");
        tell(counts.without_frequency, "GLONASS signals whose channel neither header nor navigation file tells");
        tell(counts.other_satellites, "satellites of NavIC");
        return false;
    }
};

} // namespace

std::unique_ptr<Source> open_rinex_observations(const std::string& path, Address tag, GlonassSlots slots) {
    return std::make_unique<RinexSource>(path, tag, std::move(slots));
}

} // namespace locus::importing
