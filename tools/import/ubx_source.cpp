// Logs of u-blox receivers: nobody stamped them, so their own time of week does. What tells no time (navigation words,
// sensors) belongs to the epoch before it.
#include "drivers/gnss/gps_timestamp.h"
#include "drivers/gnss/ubx.h"
#include "drivers/gnss/ubx_messages.h"
#include "drivers/wire/frame_stream.h"
#include "fusion/gnss/calendar.h"
#include "tools/import/lines.h"
#include "tools/import/source.h"

#include <cmath>

namespace locus::importing {
namespace {

using namespace gnss::ubx;
using gnss::GpsTime;

constexpr std::size_t chunk = 4096, most_held = 4096;

class UbxSource final : public Source {
  public:
    UbxSource(const std::string& path, Address tag) : file_{opened(path)}, settings_{tag, false} {
        decoder_ = gnss::make_ubx(&settings_);
    }

    bool read(std::vector<Item>& items) override {
        std::array<std::uint8_t, chunk> buffer{};
        file_.read(reinterpret_cast<char*>(buffer.data()), buffer.size());
        const auto length = static_cast<std::size_t>(file_.gcount());
        Packet packet;
        packet.data = std::span{buffer}.first(length);
        stream_.feed(
            packet, [&](const Frame& frame) { take(frame.bytes, items); },
            [&](Refusal reason) { ++report_.refused[static_cast<std::size_t>(reason)]; });
        if (length == 0 && !held_.empty()) report_.left_out["frames of a receiver that tells no week"] = held_.size();
        return length > 0;
    }

  private:
    std::ifstream file_;
    gnss::UbxSettings settings_;
    std::unique_ptr<Decoder> decoder_;
    FrameStream<Format> stream_;
    std::optional<GpsTime> epoch_;
    std::vector<std::vector<std::uint8_t>> held_; ///< came before any time was told

    void take(std::span<const std::uint8_t> frame, std::vector<Item>& items) {
        const bool known = epoch_.has_value();
        if (const auto told = time_told(frame)) epoch_ = told;
        if (!epoch_) {
            if (held_.size() < most_held) held_.emplace_back(frame.begin(), frame.end());
            return;
        }
        if (!known) {
            for (const auto& one : held_) decode(one, *epoch_, items);
            held_.clear();
        }
        decode(frame, *epoch_, items);
    }

    void decode(std::span<const std::uint8_t> frame, const GpsTime& epoch, std::vector<Item>& items) {
        ListSink sink{items, report_};
        Packet packet;
        packet.time = gnss::timestamp(epoch);
        packet.data = frame;
        decoder_->decode(packet, sink);
    }

    std::optional<GpsTime> time_told(std::span<const std::uint8_t> frame) const {
        if (message_id(frame) == RawEpoch::id) {
            const auto raw = parse_raw_epoch(payload_of(frame));
            const bool told = raw && raw->signals > 0 && std::abs(raw->receiver_time_s) <= gnss::week_s + 1;
            if (told) return GpsTime{raw->gps_week, 0} + raw->receiver_time_s;
        }
        if (message_id(frame) == NavPvt::id)
            if (const auto pvt = parse_nav_pvt(payload_of(frame))) return time_of(*pvt);
        return std::nullopt;
    }

    /// The week is that of the epoch before, or of the date; a leap second more or less does not matter for it.
    std::optional<GpsTime> time_of(const NavPvt& pvt) const {
        const auto date =
            gnss::gps_time_of_utc({pvt.year, pvt.month, pvt.day, pvt.hour, pvt.minute, double(pvt.second)});
        const auto near = epoch_ ? epoch_ : pvt.date_and_time_valid() ? date : std::nullopt;
        const double second = pvt.time_of_week_ms * 1e-3;
        if (!near || second > gnss::week_s) return std::nullopt;
        return *near + std::remainder(second - near->second, gnss::week_s);
    }
};

} // namespace

std::unique_ptr<Source> open_ubx_log(const std::string& path, Address tag) {
    return std::make_unique<UbxSource>(path, tag);
}

} // namespace locus::importing
