#include "daemon/socket/answers.h"

#include "daemon/socket/pose_line.h"
#include "fusion/vision/anonymous.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace locus {
namespace {

using nlohmann::json;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Pose some_pose(std::uint64_t target = 7) {
    Pose pose;
    pose.target = address(target);
    pose.published = timestamp_from_ns(12'000'000'345);
    pose.horizontal_error_95_m = 0.25F;
    pose.vertical_error_95_m = 0.5F;
    pose.estimate.time = timestamp_from_ns(12'000'000'000);
    pose.estimate.position_site_m = {1.5, -2.25, 0.125};
    pose.estimate.covariance[0] = 0.01;
    pose.estimate.covariance[7] = 0.02;
    pose.estimate.covariance[14] = 0.03;
    pose.estimate.kinds_used = 0b11;
    pose.estimate.missing = Missing::nothing;
    return pose;
}

Roster some_roster() {
    Settings settings;
    EngineSettings& engine = settings.engine;
    engine.site.anchors.push_back({.name = "door", .address = address(3), .position_site_m = {}});
    engine.targets.push_back({.name = "forklift", .address = address(7), .estimator = {}});
    settings.cameras.emplace_back().name = "gate";
    Roster roster;
    roster.names = Names{settings};
    roster.anchors = 1;
    roster.site = "hall";
    return roster;
}

json closed(const std::string& open_line) { return json::parse(open_line + "}"); }

TEST(PoseLine, SaysWhatTheProtocolPageSays) {
    const json line = closed(open_pose_line(some_pose(), "forklift", 4));
    EXPECT_EQ(line["class"], "POSE");
    EXPECT_EQ(line["target"], "forklift");
    EXPECT_EQ(line["position_site_m"], (std::vector<double>{1.5, -2.25, 0.125}));
    EXPECT_EQ(line["covariance_m2"], (std::vector<double>{0.01, 0, 0, 0.02, 0, 0.03}));
    EXPECT_EQ(line["kinds_used"], (std::vector<std::string>{"RANGE", "RANGE_DIFFERENCE"}));
    EXPECT_EQ(line["reset_count"], 4);
    EXPECT_DOUBLE_EQ(line["horizontal_error_95_m"], 0.25);
    EXPECT_FALSE(line.contains("orientation_xyzw")) << "not known";
    EXPECT_NE(open_pose_line(some_pose(), "x", 0).find("\"published\":12.000000345,"), std::string::npos);
}

TEST(PoseLine, SaysByWhichCameraItIsSeen) {
    const Roster roster = some_roster();
    Pose pose = some_pose();
    EXPECT_FALSE(closed(open_pose_line(pose, roster.names, 0)).contains("seen_as"));
    pose.seen_as = {address(0), 12, 0.875F};
    const json line = closed(open_pose_line(pose, roster.names, 0));
    EXPECT_EQ(line["target"], "forklift");
    EXPECT_EQ(line["seen_as"], (json{{"camera", "gate"}, {"track", 12}, {"confidence", 0.875}}));
    EXPECT_FALSE(line.contains("odometry_scale"));
    pose.estimate.odometry_scale.relative_sigma = 0.25F;
    EXPECT_EQ(closed(open_pose_line(pose, roster.names, 0))["odometry_scale"], (json{{"relative_sigma", 0.25}}));
    pose.estimate.odometry_scale.metres_per_unit = 2.5;
    EXPECT_EQ(closed(open_pose_line(pose, roster.names, 0))["odometry_scale"]["metres_per_unit"], 2.5);
    pose.target = vision::anonymous_address(address(0), 1);
    EXPECT_EQ(closed(open_pose_line(pose, roster.names, 0))["target"], "anonymous-1-2");
}

TEST(PoseLine, WithoutAFinitePositionNothingLeaves) {
    Pose pose = some_pose();
    EXPECT_TRUE(is_publishable(pose));
    pose.estimate.position_site_m[1] = nan;
    EXPECT_FALSE(is_publishable(pose));
    pose = some_pose();
    pose.estimate.missing = Missing::geometry;
    EXPECT_FALSE(is_publishable(pose));
}

RC_GTEST_PROP(PoseLine, IsJsonWhateverTheFilterSays, ()) {
    const auto value = [&] {
        return *rc::gen::element(0.0, -0.0, 1.0, 1e-300, 1e300, -1e9, 123456.789, nan, infinity, -infinity);
    };
    Pose pose = some_pose();
    for (double& v : pose.estimate.position_site_m) v = value();
    for (double& v : pose.estimate.velocity_site_mps) v = value();
    for (double& v : pose.estimate.orientation_xyzw) v = value();
    for (double& v : pose.estimate.covariance) v = value();
    pose.horizontal_error_95_m = static_cast<float>(value());
    pose.estimate.kinds_used = *rc::gen::arbitrary<std::uint32_t>();
    pose.estimator = *rc::gen::arbitrary<std::uint16_t>();
    pose.published = timestamp_from_ns(*rc::gen::arbitrary<std::int64_t>());
    const json line = json::parse(open_pose_line(pose, *rc::gen::arbitrary<std::string>(), 0) + "}", nullptr, false);
    RC_ASSERT(line.is_object());
    RC_ASSERT(line.dump(-1, ' ', false, json::error_handler_t::replace).find("null") == std::string::npos);
}

TEST(Answers, EachIsOneLineOfItsClass) {
    const Picture picture;
    const Roster roster = some_roster();
    for (const auto& [line, name] : {std::pair{version_line(roster), "VERSION"},
                                     {watch_line({}), "WATCH"},
                                     {sources_line(picture, roster, {}, {}), "SOURCES"},
                                     {targets_line(picture, roster, {}), "TARGETS"},
                                     {status_line(picture, roster, 1, {}), "STATUS"},
                                     {poll_lines(picture, roster), "POLL"},
                                     {reload_line(false, {"a.yaml:1:2: no"}), "RELOAD"},
                                     {error_line("no"), "ERROR"}}) {
        EXPECT_EQ(line.find('\n'), line.size() - 1) << name;
        EXPECT_EQ(json::parse(line)["class"], name);
    }
}

TEST(Answers, AnAnchorTellsItsHealth) {
    Picture picture;
    AidStatus status;
    status.source = address(3);
    status.health.state = AnchorState::moved;
    status.health.since = timestamp_from_s(5);
    status.health.moved_m = 1.5F;
    status.health.stands_site_m = {1, 2, unknown_f};
    picture.take(SourceItem{1, 0, 1, status});
    const json line = json::parse(sources_line(picture, some_roster(), {}, timestamp_from_s(15)));
    const json& health = line["sources"][0]["health"];
    EXPECT_EQ(health["state"], "moved");
    EXPECT_DOUBLE_EQ(health["since_s"], 10);
    EXPECT_FALSE(health.contains("residual_m")) << "not known";
    EXPECT_EQ(health["stands_site_m"], json::parse("[1.0,2.0,null]"));
}

TEST(Answers, SourceIsNamedAndItsUnknownValuesAreLeftOut) {
    Picture picture;
    AidStatus status;
    status.source = address(3);
    status.last_verdict.reason = Exclusion::innovation_too_large;
    status.last_verdict.innovation = 2.5F;
    picture.take(SourceItem{1, 0, 1, status});
    const json source = json::parse(sources_line(picture, some_roster(), {}, {}))["sources"][0];
    EXPECT_EQ(source["name"], "door");
    EXPECT_EQ(source["address"], "0x3");
    EXPECT_EQ(source["used"], false);
    EXPECT_EQ(source["reason"], "innovation_too_large");
    EXPECT_EQ(source["sentence"], exclusion_sentence(Exclusion::innovation_too_large));
    EXPECT_DOUBLE_EQ(source["innovation"], 2.5);
    EXPECT_FALSE(source.contains("test_ratio"));
    EXPECT_FALSE(source.contains("age_s"));
}

TEST(Answers, ASatelliteSaysWhatBecameOfItsCarrier) {
    AidStatus status;
    status.kind = SourceKind::satellite;
    status.source = address(5);
    status.last_verdict = Verdict{};
    const auto told = [&] {
        Picture picture;
        picture.take(SourceItem{1, 0, 1, status});
        return json::parse(sources_line(picture, some_roster(), {}, {}))["sources"][0];
    };
    EXPECT_FALSE(told().contains("carrier")) << "there is none";
    status.last_verdict.carrier = CarrierUse::slipped;
    EXPECT_EQ(told()["carrier"], "slipped");
}

TEST(Answers, InputSaysItsRatesAndItsLastError) {
    auto status = std::make_shared<InputStatus>();
    status->state = InputState::open;
    status->resyncs = 3;
    Roster roster = some_roster();
    roster.inputs = {{"uwb", "serial", "trek1000", status}, {"off", "serial", "trek1000", nullptr}};
    InputRates rates;
    const auto input = [&](double now_s) {
        const Timestamp now = Timestamp{} + duration_from_s(now_s);
        return json::parse(sources_line({}, roster, rates, now))["inputs"][0];
    };
    rates.watch(roster.inputs, Timestamp{} + duration_from_s(100));
    EXPECT_FALSE(input(100.5).contains("bytes_per_s")) << "half a second says little";
    EXPECT_FALSE(input(100.5).contains("last_error"));
    status->bytes = 400, status->frames = 40, status->measurements = 120, status->packets = 20;
    status->last_error.set("it fell off");
    status->last_error_ns = 101'000'000'000;
    EXPECT_EQ(input(104)["bytes_per_s"], 100.0);
    EXPECT_EQ(input(104)["packets_per_s"], 5.0);
    EXPECT_EQ(input(104)["frames_per_s"], 10.0);
    EXPECT_EQ(input(104)["measurements_per_s"], 30.0);
    EXPECT_EQ(input(104)["resyncs"], 3);
    EXPECT_EQ(input(104)["error"], "");
    EXPECT_EQ(input(104)["last_error"], "it fell off");
    EXPECT_EQ(input(104)["last_error_age_s"], 3.0);
}

TEST(InputRates, LooksBackSomeSecondsAndForgetsInputsThatAreNoMore) {
    auto status = std::make_shared<InputStatus>();
    const std::vector<InputEntry> inputs{{"uwb", "serial", "trek1000", status}};
    InputRates rates;
    const auto at = [](double s) { return Timestamp{} + duration_from_s(s); };
    for (int ms = 0; ms <= 20'000; ms += 100) {
        if (ms == 10'000) status->frames = 1000;
        rates.watch(inputs, at(ms * 1e-3));
    }
    EXPECT_EQ(rates.rate(*status, at(20.5)).value().frames, 0) << "the burst is long ago";
    status->frames = 1045;
    EXPECT_EQ(rates.rate(*status, at(20.5)).value().frames, 10) << "45 since second 16";
    rates.watch({}, at(30));
    EXPECT_FALSE(rates.rate(*status, at(31)));
}

TEST(Answers, PollGivesTheNewestPoseOfEveryTargetThatHasOne) {
    Picture picture;
    picture.take(PoseItem{1, some_pose(7)});
    Pose none = some_pose(8);
    none.estimate.missing = Missing::anchors;
    picture.take(PoseItem{1, none});
    const std::string lines = poll_lines(picture, some_roster());
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2);
    EXPECT_NE(lines.find("\"target\":\"forklift\""), std::string::npos);
    EXPECT_NE(lines.find("{\"class\":\"POLL\",\"poses\":1}"), std::string::npos);
}

TEST(Answers, WhatPeopleCallThingsCannotBreakALine) {
    const std::string nasty{"a\"\n\xff;\x01", 6};
    EXPECT_EQ(error_line(nasty).find('\n'), error_line(nasty).size() - 1);
    EXPECT_TRUE(json::parse(error_line(nasty), nullptr, false).is_object());
    EXPECT_TRUE(closed(open_pose_line(some_pose(), nasty, 0)).is_object());
}

} // namespace
} // namespace locus
