// Raw observations through the engine: words and signals in; satellite ranges, own fixes and reasons out.
#include "fusion/engine.h"
#include "fusion/gnss/ephemeris_words.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/gnss/synthetic_sky.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace locus::gnss {
namespace {

using synthetic::start;

/// What an estimator was given. Estimators are copied, so it is kept outside.
struct Given {
    std::vector<SatelliteRange> ranges;
    std::vector<GnssFix> fixes;
};

class Listener final : public Estimator {
  public:
    explicit Listener(Given* given) : given_{given} {}
    Verdict update(const Measurement& measurement) noexcept override {
        if (const auto* range = std::get_if<SatelliteRange>(&measurement.observation)) given_->ranges.push_back(*range);
        if (const auto* fix = std::get_if<GnssFix>(&measurement.observation)) given_->fixes.push_back(*fix);
        return {};
    }
    Estimate predict(Timestamp) const noexcept override { return {}; }
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<Listener>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const Listener&>(other); }

  private:
    Given* given_;
};

struct ListenerSettings {
    Given* given = nullptr;
};

const EstimatorRow listener_row{"listener", "for tests", option_table<ListenerSettings>({}),
                                [](const Site&, const void* settings) -> std::unique_ptr<Estimator> {
                                    return std::make_unique<Listener>(
                                        static_cast<const ListenerSettings*>(settings)->given);
                                }};

class ReceiversTest : public testing::Test {
  protected:
    synthetic::Truth truth;
    EngineSettings settings;
    Given given;
    double now_s = 100;
    std::uint32_t sequence = 0;
    std::unique_ptr<Engine> engine;

    ReceiversTest() {
        settings.fusion.estimator = "listener";
        settings.fusion.max_targets = 2;
        settings.targets.push_back({"car", address(7), {}});
        settings.estimators.push_back({&listener_row, std::make_shared<ListenerSettings>(ListenerSettings{&given})});
    }

    void submit(const Observation& observation) {
        if (!engine) engine = std::make_unique<Engine>(settings);
        const Timestamp time = timestamp_from_s(now_s);
        engine->submit({time, ++sequence, 0, observation}, time);
    }
    void step() {
        for (int i = 0; i < 10; ++i) engine->step(timestamp_from_s(now_s += 0.01));
    }
    void tell(const KeplerEphemeris& e) {
        for (auto words : encode(Ephemeris{e}, start, 18)) {
            words.tag = address(7);
            submit(words);
        }
    }
    void tell_all() {
        auto words = encode(synthetic::ionosphere, 6, start);
        ASSERT_TRUE(words);
        submit(*words);
        for (const auto& e : synthetic::satellites()) tell(e);
    }
    /// One epoch, so that the time is known, then all words, then nothing for a moment.
    void learn() {
        for (const GnssRaw& raw : epoch(0)) submit(raw);
        tell_all();
        step();
        given = {};
    }
    std::vector<GnssRaw> epoch(double after_s) {
        synthetic::Truth then = truth;
        then.position_ecef_m = truth.at(after_s);
        return synthetic::epoch(then, start + after_s);
    }
    std::uint64_t count(Exclusion reason) const {
        return engine->counters().by_reason[static_cast<std::size_t>(reason)];
    }
};

TEST_F(ReceiversTest, EpochsBecomeRangesAndFixes) {
    learn();
    for (const GnssRaw& raw : epoch(1)) submit(raw);
    EXPECT_TRUE(given.ranges.empty()) << "the epoch is not complete";
    step();
    ASSERT_EQ(given.fixes.size(), 1u);
    EXPECT_GE(given.ranges.size(), 12u);
    const GnssFix& fix = given.fixes[0];
    const Eigen::Vector3d at_m = ecef_m({fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m});
    EXPECT_LT((at_m - truth.at(1)).norm(), 0.5) << "fields of the words are rounded: orbits to decimetres";
    EXPECT_EQ(fix.fix_type, gnss_fix_type::full);
    EXPECT_EQ(fix.satellites, given.ranges.size());
    EXPECT_GT(fix.sigma_horizontal_m, 0.3);
    EXPECT_LT(fix.sigma_horizontal_m, 5);
    const Eigen::Vector3d enu_mps = enu_to_ecef(geodetic(truth.at(1))).transpose() * truth.velocity_ecef_mps;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(fix.velocity_enu_mps[static_cast<std::size_t>(i)], enu_mps[i], 0.05);
}

TEST_F(ReceiversTest, EveryRawObservationIsCountedOnceWithItsReason) {
    learn();
    for (const GnssRaw& raw : epoch(1)) submit(raw);
    step();
    const EngineCounters& counters = engine->counters();
    EXPECT_EQ(counters.received, counters.used + counters.refused + counters.late);
    EXPECT_GT(count(Exclusion::too_low), 0u);
    for (const AidStatus& status : engine->sources()) {
        const bool used = status.kind == SourceKind::satellite && status.last_verdict.reason == Exclusion::none;
        EXPECT_TRUE(!used || status.last_observation > 1e7) << "a pseudorange, not what the words said";
    }
}

/// Heard at 1 s and 2 s, with a receiver's epoch between.
TEST_F(ReceiversTest, ABaseStationIsASourceOfItsOwnAndMakesFixesDifferential) {
    learn();
    synthetic::Truth base;
    base.velocity_ecef_mps.setZero();
    std::uint64_t told = 0;
    for (const double after_s : {1.0, 2.0}) {
        for (const GnssRaw& raw : synthetic::epoch(base, start + after_s)) {
            GnssBaseRange range{address(2003), raw.receiver_time_s_in_gps_week, raw.pseudorange_m};
            for (std::size_t i = 0; i < 3; ++i)
                range.antenna_ecef_m[i] = base.position_ecef_m[static_cast<Eigen::Index>(i)];
            range.carrier_to_noise_dbhz = 45;
            range.constellation = raw.constellation;
            range.satellite = raw.satellite;
            submit(range);
            ++told;
        }
        for (const GnssRaw& raw : epoch(after_s + 0.2)) submit(raw);
        step();
    }
    ASSERT_EQ(given.fixes.size(), 2u);
    EXPECT_EQ(given.fixes.back().fix_type, gnss_fix_type::differential);
    const auto sources = engine->sources();
    const auto shown = std::ranges::find(sources, SourceKind::base, &AidStatus::kind);
    ASSERT_NE(shown, sources.end());
    EXPECT_EQ(shown->source, address(2003));
    EXPECT_EQ(shown->last_verdict.reason, Exclusion::none);
    EXPECT_EQ(shown->counters.received, told);
    EXPECT_EQ(shown->counters.used, told / 2) << "the first epoch came before there was anything to correct";
    EXPECT_GT(shown->last_used_time, Timestamp{});
}

TEST_F(ReceiversTest, TwoSatellitesStillGiveTheirRanges) {
    learn();
    auto raws = epoch(1);
    std::erase_if(raws, [](const GnssRaw& raw) { return raw.constellation != constellation::galileo; });
    raws.resize(2);
    for (const GnssRaw& raw : raws) submit(raw);
    step();
    EXPECT_TRUE(given.fixes.empty());
    ASSERT_FALSE(given.ranges.empty());
    for (const SatelliteRange& range : given.ranges) {
        const double distance_m = (vector(range.satellite_ecef_m) - truth.at(1)).norm();
        EXPECT_NEAR(range.pseudorange_m, distance_m + truth.clocks_m[1], 0.7);
    }
}

TEST_F(ReceiversTest, BeforeAFirstPositionTwoSatellitesNeedTheOriginOfTheSite) {
    for (const bool anchored : {false, true}) {
        engine.reset();
        given = {};
        if (anchored) settings.site.origin = Wgs84Anchor{48.1, 11.7, 500};
        submit(epoch(0)[0]);
        tell_all();
        step();
        given = {};
        auto raws = epoch(1);
        raws.resize(3);
        for (const GnssRaw& raw : raws) submit(raw);
        step();
        EXPECT_EQ(given.ranges.empty(), !anchored);
        EXPECT_EQ(count(Exclusion::no_position_yet) > 0, !anchored);
    }
}

TEST_F(ReceiversTest, AReceiverThatTellsFixesGetsNone) {
    learn();
    GnssFix told;
    told.tag = address(7);
    told.fix_type = gnss_fix_type::full;
    told.satellites = 99;
    submit(told);
    for (const GnssRaw& raw : epoch(1)) submit(raw);
    step();
    ASSERT_EQ(given.fixes.size(), 1u);
    EXPECT_EQ(given.fixes[0].satellites, 99);
    now_s += 5;
    for (const GnssRaw& raw : epoch(5)) submit(raw);
    step();
    EXPECT_EQ(given.fixes.size(), 2u) << "it fell silent";
}

TEST_F(ReceiversTest, SettingsSwitchOffRangesOrFixes) {
    settings.gnss.own_fix = false;
    learn();
    for (const GnssRaw& raw : epoch(1)) submit(raw);
    step();
    EXPECT_TRUE(given.fixes.empty());
    EXPECT_FALSE(given.ranges.empty());
    engine.reset();
    settings.gnss.own_fix = true;
    settings.gnss.satellite_ranges = false;
    learn();
    const auto used_before = engine->counters().used;
    for (const GnssRaw& raw : epoch(1)) submit(raw);
    step();
    EXPECT_EQ(given.fixes.size(), 1u);
    EXPECT_TRUE(given.ranges.empty());
    EXPECT_GT(engine->counters().used, used_before + 12) << "they are used: in the fix";
}

TEST_F(ReceiversTest, EachReasonIsGiven) {
    auto told = synthetic::satellites();
    const auto raws = epoch(0);
    const auto sick = raws[0].satellite, silent = raws[3].satellite;
    ASSERT_EQ(raws[0].constellation, raws[3].constellation);
    submit(raws[0]);
    for (auto e : told) {
        if (e.constellation == raws[0].constellation && e.satellite == silent) continue;
        if (e.constellation == raws[0].constellation && e.satellite == sick) e.health = 0x3F;
        tell(e);
    }
    step();
    auto again = epoch(1);
    again[4].carrier_to_noise_dbhz = 12;
    again[5].pseudorange_m = 5;
    again[6].pseudorange_m += 3000;
    again.push_back(again[7]);
    again.back().signal = 4;
    again.push_back(again[7]);
    GnssRaw timeless = again[8];
    timeless.receiver_time_s_in_gps_week = 1e300;
    again.push_back(timeless);
    for (const GnssRaw& raw : again) submit(raw);
    step();
    for (const auto reason :
         {Exclusion::no_ephemeris, Exclusion::unhealthy, Exclusion::too_weak, Exclusion::impossible_range,
          Exclusion::other_signal, Exclusion::duplicate, Exclusion::impossible_time})
        EXPECT_GE(count(reason), 1u) << exclusion_name(reason);
    EXPECT_GE(count(Exclusion::inconsistent) + count(Exclusion::too_low), 1u);
    for (const GnssRaw& raw : epoch(20000)) submit(raw);
    step();
    EXPECT_GT(count(Exclusion::ephemeris_too_old), 5u);
}

TEST_F(ReceiversTest, OrderOfArrivalDoesNotMatter) {
    learn();
    auto raws = epoch(1);
    const auto keep = sequence;
    const auto run = [&](std::vector<GnssRaw> shuffled) {
        for (const GnssRaw& raw : shuffled) {
            const auto place = std::ranges::find_if(raws, [&](const GnssRaw& r) {
                return r.constellation == raw.constellation && r.satellite == raw.satellite;
            });
            sequence = keep + static_cast<std::uint32_t>(place - raws.begin());
            submit(raw);
        }
        step();
        return std::exchange(given, {});
    };
    const Given first = run(raws);
    engine.reset();
    sequence = 0;
    now_s = 100;
    learn();
    auto backwards = raws;
    std::ranges::reverse(backwards);
    const Given second = run(backwards);
    ASSERT_EQ(first.ranges.size(), second.ranges.size());
    EXPECT_EQ(first.fixes[0].latitude_deg, second.fixes[0].latitude_deg);
    for (std::size_t i = 0; i < first.ranges.size(); ++i)
        EXPECT_EQ(first.ranges[i].pseudorange_m, second.ranges[i].pseudorange_m);
}

/// Bits turned and numbers out of all bounds; seed 3. Nothing that is not finite leaves, nothing is allocated.
TEST_F(ReceiversTest, HostileObservationsAndWordsLeaveFiniteNumbersOnly) {
    learn();
    given.ranges.reserve(100000);
    given.fixes.reserve(10000);
    std::mt19937 random(3);
    const std::array<double, 8> odd{0, -1, 1e300, -1e300, 2.2e7, 1e-300, 5e7, 604799};
    std::vector<std::vector<GnssNavigation>> words;
    for (const auto& e : synthetic::satellites()) words.push_back(encode(Ephemeris{e}, start, 18));
    std::vector<std::vector<GnssRaw>> epochs;
    for (int i = 0; i < 40; ++i) epochs.push_back(epoch(i + 1));
    const test::AllocationCount allocations;
    for (const auto& raws : epochs) {
        for (GnssRaw raw : raws) {
            if (random() % 3 == 0) raw.pseudorange_m = odd[random() % odd.size()];
            if (random() % 5 == 0) raw.carrier_cycles = odd[random() % odd.size()];
            if (random() % 5 == 0) raw.doppler_hz = static_cast<float>(odd[random() % odd.size()] / 1e263);
            if (random() % 5 == 0) raw.sigma_pseudorange_m = 3e38F;
            if (random() % 5 == 0) raw.carrier_to_noise_dbhz = random() % 2 ? 3e38F : 60;
            if (random() % 9 == 0) raw.constellation = static_cast<std::uint8_t>(random());
            if (random() % 9 == 0) raw.satellite = static_cast<std::uint8_t>(random());
            if (random() % 9 == 0) raw.glonass_slot = static_cast<std::uint8_t>(random());
            submit(raw);
        }
        for (auto one : words[random() % words.size()]) {
            for (auto& word : one.words)
                if (random() % 3 == 0) word ^= 1U << random() % 32;
            if (random() % 4 == 0) one.word_count = static_cast<std::uint8_t>(random());
            submit(one);
        }
        step();
        now_s += 0.9;
    }
    EXPECT_EQ(allocations.made(), 0u);
    EXPECT_GT(given.ranges.size(), 40u);
    for (const SatelliteRange& range : given.ranges) {
        EXPECT_TRUE(std::isfinite(range.pseudorange_m) && std::isfinite(range.carrier_m));
        EXPECT_TRUE(std::isfinite(range.sigma_m) && std::isfinite(range.sigma_rate_mps));
        EXPECT_TRUE(vector(range.satellite_ecef_m).allFinite());
    }
    for (const GnssFix& fix : given.fixes)
        EXPECT_TRUE(std::isfinite(fix.latitude_deg + double{fix.sigma_horizontal_m}));
}

} // namespace
} // namespace locus::gnss
