// A recording through the very receivers of the engine, without an engine: what they give out.
#pragma once

#include "fusion/gnss/receivers.h"

#include <array>
#include <vector>

namespace locus::test {

class ReceiverRun final : public gnss::Receivers::Output {
  public:
    struct Fix {
        Timestamp time;
        GnssFix fix;

        Eigen::Vector3d ecef_m() const {
            return locus::ecef_m({fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m});
        }
    };

    std::vector<Fix> fixes;
    std::vector<SatelliteRange> ranges;
    std::array<std::size_t, exclusion_count> reasons{};

    explicit ReceiverRun(const GnssSettings& settings) : receivers_{Site{}, settings, duration_from_s(0.1)} {}

    void hear(const Measurement& m) {
        if (const auto* words = std::get_if<GnssNavigation>(&m.observation)) receivers_.hear(*words);
        if (const auto* base = std::get_if<GnssBaseRange>(&m.observation)) receivers_.hear(*base, m.input);
        if (!std::holds_alternative<GnssRaw>(m.observation)) return;
        const Exclusion reason = receivers_.hear(m, {}, m.time, *this);
        if (reason != Exclusion::none) judge(m, {}, reason);
        newest_ = std::max(newest_, m.time);
    }
    void finish() { receivers_.run(newest_ + std::chrono::hours{1}, *this); }

    std::size_t count(Exclusion reason) const { return reasons[static_cast<std::size_t>(reason)]; }

  private:
    gnss::Receivers receivers_;
    Timestamp newest_{};

    void take(const Measurement& range, const AidBook::Record& record) noexcept override {
        ranges.push_back(std::get<SatelliteRange>(range.observation)); // NOLINT(bugprone-exception-escape)
        judge(range, record, Exclusion::none);
    }
    void judge(const Measurement& /*raw*/, const AidBook::Record& /*record*/, Exclusion reason) noexcept override {
        ++reasons[static_cast<std::size_t>(reason)];
    }
    void tell(const Measurement& fix) noexcept override {
        fixes.push_back({fix.time, std::get<GnssFix>(fix.observation)}); // NOLINT(bugprone-exception-escape)
    }
};

} // namespace locus::test
