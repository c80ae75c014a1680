// The NMEA output: its sentences read back by the decoder of receivers, its terminal by a reader, and by gpsd.
#include "daemon/nmea/output.h"
#include "daemon/nmea/sentences.h"
#include "drivers/clock.h"
#include "drivers/gnss/nmea.h"
#include "drivers/gnss/nmea_messages.h"
#include "tests/support/socket_client.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace locus {
namespace {

const Wgs84Anchor depot{-35.667574, 139.791074, 39.5, 40}; // south, so that signs matter; x axis to 40 degrees
constexpr std::int64_t midday_us = 1'795'348'800'000'000;  // 2026-11-22 12:00:00 UTC

Pose pose_of_shuttle(double x_mps = 3) {
    Pose pose;
    pose.target = address(1);
    pose.horizontal_error_95_m = 2;
    pose.estimate.missing = Missing::nothing;
    pose.estimate.position_site_m = {100, -20, 3};
    pose.estimate.velocity_site_mps = {x_mps, 0, 0};
    pose.estimate.orientation_xyzw = {0, 0, 0, 1};
    pose.estimate.kinds_used = 1U << Observation{GnssFix{}}.index();
    pose.estimate.covariance[0] = pose.estimate.covariance[7] = 0.25;
    pose.estimate.covariance[14] = 4;
    return pose;
}

struct SentencesRead {
    std::vector<std::string> lines;
    std::optional<gnss::nmea::Gga> gga;
    std::optional<gnss::nmea::Rmc> rmc;
    std::optional<gnss::nmea::Vtg> vtg;
    std::optional<gnss::nmea::Gst> gst;
    std::optional<gnss::nmea::Hdt> hdt;
};

SentencesRead read_back(const std::string& text) {
    SentencesRead read;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        EXPECT_EQ(line.back(), '\r');
        line.pop_back();
        read.lines.push_back(line);
        const auto parsed = gnss::nmea::parse_sentence(line, true);
        const auto* sentence = std::get_if<gnss::nmea::Sentence>(&parsed);
        if (sentence == nullptr) {
            ADD_FAILURE() << line;
            continue;
        }
        if (sentence->type == "GGA") read.gga = parse_gga(*sentence);
        if (sentence->type == "RMC") read.rmc = parse_rmc(*sentence);
        if (sentence->type == "VTG") read.vtg = parse_vtg(*sentence);
        if (sentence->type == "GST") read.gst = parse_gst(*sentence);
        if (sentence->type == "HDT") read.hdt = parse_hdt(*sentence);
    }
    return read;
}

SentencesRead told(const Pose* pose, const UtcTime& time = {midday_us, false}) {
    NmeaOutputSettings settings;
    settings.geoid_height_m = 36.5;
    return read_back(nmea_sentences(settings, SiteOnEarth{depot}, pose, time));
}

TEST(NmeaSentences, TellThePlaceTheSpeedAndTheHeading) {
    const Pose pose = pose_of_shuttle();
    const SentencesRead read = told(&pose);
    ASSERT_TRUE(read.gga && read.rmc && read.vtg && read.gst && read.hdt);
    const Eigen::Vector3d expected_m = SiteOnEarth{depot}.ecef_m({100, -20, 3});
    const Geodetic place{read.gga->latitude_deg, read.gga->longitude_deg,
                         read.gga->altitude_sea_level_m + read.gga->geoid_separation_m};
    EXPECT_LT((ecef_m(place) - expected_m).norm(), 2e-3) << "GGA tells millimetres";
    EXPECT_EQ(read.gga->quality, 1U);
    EXPECT_NEAR(read.gga->geoid_separation_m, 36.5, 1e-9);
    EXPECT_EQ(read.gga->time_us, std::int64_t{12} * 3600 * 1'000'000);
    EXPECT_TRUE(read.rmc->valid);
    EXPECT_EQ(read.rmc->mode, 'A');
    EXPECT_EQ(read.rmc->date_ddmmyy, 221126U);
    EXPECT_NEAR(read.rmc->speed_knots, 3 * 3600 / 1852.0, 1e-3);
    EXPECT_NEAR(read.rmc->course_deg, 40, 0.01) << "the site's x axis";
    EXPECT_NEAR(read.vtg->speed_knots, read.rmc->speed_knots, 1e-9);
    EXPECT_NEAR(read.hdt->heading_deg, 40, 0.01);
    EXPECT_NEAR(read.gst->sigma_latitude_m, 0.5, 1e-3);
    EXPECT_NEAR(read.gst->sigma_altitude_m, 2, 1e-3);
}

TEST(NmeaSentences, TheDecoderOfReceiversMakesTheSameFixOfThem) {
    struct Fixes : MeasurementSink {
        std::vector<GnssFix> fixes;
        void accept(Timestamp /*time*/, const Observation& observation) override {
            if (const auto* fix = std::get_if<GnssFix>(&observation)) fixes.push_back(*fix);
        }
        void frame(std::span<const std::uint8_t> /*bytes*/) override {}
        void refuse(Refusal /*reason*/) override { ADD_FAILURE(); }
    } sink;
    gnss::NmeaSettings settings;
    settings.tag = address(7);
    const auto decoder = gnss::make_nmea(&settings);
    const Pose pose = pose_of_shuttle();
    for (int second = 0; second < 3; ++second) {
        const std::string lines =
            nmea_sentences({}, SiteOnEarth{depot}, &pose, {midday_us + second * std::int64_t{1'000'000}, false});
        Packet packet;
        packet.time = timestamp_from_s(100 + second);
        packet.data = {reinterpret_cast<const std::uint8_t*>(lines.data()), lines.size()};
        decoder->decode(packet, sink);
    }
    ASSERT_GE(sink.fixes.size(), 2U);
    const GnssFix& fix = sink.fixes.back();
    const Geodetic place{fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m};
    EXPECT_LT((ecef_m(place) - SiteOnEarth{depot}.ecef_m({100, -20, 3})).norm(), 2e-3);
    EXPECT_NEAR(std::hypot(fix.velocity_enu_mps[0], fix.velocity_enu_mps[1]), 3, 1e-3);
    EXPECT_NEAR(fix.sigma_vertical_m, 2, 1e-3);
}

TEST(NmeaSentences, DeadReckoningIsToldAsSuch) {
    Pose pose = pose_of_shuttle();
    pose.estimate.kinds_used = 1U << Observation{ImuSample{}}.index() | 1U << Observation{WheelSpeed{}}.index();
    const SentencesRead read = told(&pose);
    ASSERT_TRUE(read.gga && read.rmc && read.vtg);
    EXPECT_EQ(read.gga->quality, 6U);
    EXPECT_TRUE(read.rmc->valid);
    EXPECT_EQ(read.rmc->mode, 'E');
    EXPECT_EQ(read.vtg->mode, 'E');
}

void expect_none(const SentencesRead& read) {
    ASSERT_TRUE(read.gga && read.rmc && read.vtg);
    EXPECT_EQ(read.gga->quality, 0U);
    EXPECT_TRUE(std::isnan(read.gga->latitude_deg));
    EXPECT_FALSE(read.rmc->valid);
    EXPECT_EQ(read.rmc->mode, 'N');
    EXPECT_EQ(read.rmc->date_ddmmyy, 221126U) << "the time is known all the same";
    EXPECT_EQ(read.vtg->mode, 'N');
    EXPECT_EQ(read.lines.size(), 3U);
}

TEST(NmeaSentences, NoPoseOneThatIsMissingAndOneTooUncertainAreNone) {
    expect_none(told(nullptr));
    Pose pose = pose_of_shuttle();
    pose.estimate.missing = Missing::fresh_measurements;
    expect_none(told(&pose));
    pose = pose_of_shuttle();
    pose.horizontal_error_95_m = 101;
    expect_none(told(&pose));
    pose.horizontal_error_95_m = std::numeric_limits<float>::quiet_NaN();
    expect_none(told(&pose));
}

TEST(NmeaSentences, WhatIsNotKnownStaysEmpty) {
    Pose pose = pose_of_shuttle(0);
    pose.estimate.orientation_xyzw = {};
    const SentencesRead read = told(&pose);
    EXPECT_FALSE(read.hdt);
    ASSERT_TRUE(read.rmc);
    EXPECT_TRUE(std::isnan(read.rmc->course_deg)) << "nothing moves";
    EXPECT_EQ(read.rmc->speed_knots, 0);
}

TEST(NmeaSentences, ALeapSecondIsItsSixtieth) {
    const std::int64_t last_us = 1'483'228'799'500'000; // 2016-12-31 23:59:59.5
    EXPECT_NE(told(nullptr, {last_us, false}).lines[0].find(",235959.5"), std::string::npos);
    const SentencesRead read = told(nullptr, {last_us, true});
    EXPECT_NE(read.lines[0].find(",235960.5"), std::string::npos);
    EXPECT_EQ(read.rmc->date_ddmmyy, 311216U);
}

NmeaPlan plan_in(const test::TemporaryFolder& folder) {
    NmeaPlan plan;
    plan.settings.link = folder / "nmea";
    plan.target = address(1);
    plan.origin = depot;
    return plan;
}

std::string read_for(int fd, std::size_t least) {
    std::string text;
    std::array<char, 4096> buffer{};
    test::eventually([&] {
        const ssize_t got = ::read(fd, buffer.data(), buffer.size());
        if (got > 0) text.append(buffer.data(), static_cast<std::size_t>(got));
        return text.size() >= least;
    });
    return text;
}

TEST(NmeaOutput, AReaderOfTheTerminalGetsTheLinesAndTheLinkGoesWithIt) {
    const test::TemporaryFolder folder;
    const NmeaPlan plan = plan_in(folder);
    {
        NmeaOutput output{plan};
        EXPECT_TRUE(std::filesystem::is_symlink(plan.settings.link));
        const UniqueFd reader{::open(plan.settings.link.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK)};
        ASSERT_TRUE(reader);
        Pose pose = pose_of_shuttle();
        pose.estimate.time = monotonic_now();
        output.take(pose);
        pose.target = address(2);
        pose.estimate.position_site_m = {0, 0, 0};
        output.take(pose);
        output.run(monotonic_now());
        const SentencesRead read = read_back(read_for(reader.get(), 250));
        ASSERT_TRUE(read.gga);
        EXPECT_EQ(read.gga->quality, 1U);
        const Geodetic place{read.gga->latitude_deg, read.gga->longitude_deg, read.gga->altitude_sea_level_m};
        EXPECT_LT((ecef_m(place) - SiteOnEarth{depot}.ecef_m({100, -20, 3})).norm(), 2e-3) << "not the other target's";
    }
    EXPECT_FALSE(std::filesystem::is_symlink(plan.settings.link));
}

TEST(NmeaOutput, APoseOfLongAgoIsNone) {
    const test::TemporaryFolder folder;
    const NmeaPlan plan = plan_in(folder);
    NmeaOutput output{plan};
    const UniqueFd reader{::open(plan.settings.link.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK)};
    Pose pose = pose_of_shuttle();
    pose.estimate.time = monotonic_now() - std::chrono::seconds{2};
    output.take(pose);
    output.run(monotonic_now());
    EXPECT_EQ(read_back(read_for(reader.get(), 60)).gga->quality, 0U); // NOLINT(bugprone-unchecked-optional-access)
}

TEST(NmeaOutput, WhoDoesNotReadStopsNothingAndGetsTheNewestLines) {
    const test::TemporaryFolder folder;
    const NmeaPlan plan = plan_in(folder);
    NmeaOutput output{plan};
    const UniqueFd reader{::open(plan.settings.link.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK)};
    const Timestamp start = monotonic_now();
    const int moments = 500; // 150 kB; a terminal holds 4 or so
    for (int i = 0; i < moments; ++i) {
        Pose pose = pose_of_shuttle();
        pose.estimate.time = start + std::chrono::seconds{i};
        pose.estimate.position_site_m[0] = i; // metres along 40 degrees
        output.take(pose);
        output.run(pose.estimate.time);
    }
    EXPECT_LT(read_for(reader.get(), 300).size(), 20'000U) << "what it had no room for is thrown away";

    Pose newest = pose_of_shuttle();
    newest.estimate.time = start + std::chrono::seconds{moments};
    newest.estimate.position_site_m = {-7, 7, 0};
    output.take(newest);
    output.run(newest.estimate.time);
    const std::string all = nmea_sentences({}, SiteOnEarth{depot}, &newest, {});
    const auto place = all.find("3540."); // the latitude
    const std::string wanted = all.substr(place, 28);
    std::string text;
    EXPECT_TRUE(test::eventually([&] { return (text += read_for(reader.get(), 1)).find(wanted) != std::string::npos; }))
        << wanted;
}

TEST(NmeaOutput, AFileInTheWayIsNotRemoved) {
    const test::TemporaryFolder folder;
    const NmeaPlan plan = plan_in(folder);
    std::ofstream{plan.settings.link} << "precious";
    EXPECT_THROW(NmeaOutput{plan}, std::runtime_error);
    EXPECT_TRUE(std::filesystem::is_regular_file(plan.settings.link));
}

/// gpsd of Debian on the terminal, without a socket of its own but one in a folder.
class Gpsd {
  public:
    Gpsd(const std::string& device, int port) : pid_{::fork()} {
        if (pid_ != 0) return;
        const std::string number = std::to_string(port);
        ::execl("/usr/sbin/gpsd", "gpsd", "-N", "-n", "-b", "-S", number.c_str(), device.c_str(), nullptr);
        ::_exit(127);
    }
    ~Gpsd() {
        ::kill(pid_, SIGTERM);
        ::waitpid(pid_, nullptr, 0);
    }
    Gpsd(const Gpsd&) = delete;
    Gpsd& operator=(const Gpsd&) = delete;

  private:
    pid_t pid_;
};

UniqueFd call_gpsd(int port) {
    UniqueFd fd{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(static_cast<std::uint16_t>(port));
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) return UniqueFd{};
    ::fcntl(fd.get(), F_SETFL, O_NONBLOCK);
    constexpr std::string_view watch = "?WATCH={\"enable\":true,\"json\":true};";
    return ::write(fd.get(), watch.data(), watch.size()) > 0 ? std::move(fd) : UniqueFd{};
}

/// The first TPV of gpsd that has a position; empty when none comes.
std::optional<nlohmann::json> first_position(int fd, const std::function<void()>& between) {
    std::string text;
    std::optional<nlohmann::json> found;
    test::eventually([&] {
        between();
        std::array<char, 4096> buffer{};
        const ssize_t got = ::read(fd, buffer.data(), buffer.size());
        if (got > 0) text.append(buffer.data(), static_cast<std::size_t>(got));
        for (auto end = text.find('\n'); end != std::string::npos; text.erase(0, end + 1), end = text.find('\n')) {
            const auto one = nlohmann::json::parse(text.substr(0, end), nullptr, false);
            if (one.is_object() && one.value("class", "") == "TPV" && one.contains("lat")) found = one;
        }
        return found.has_value();
    });
    return found;
}

TEST(NmeaOutput, GpsdReadsThePlace) {
    if (::access("/usr/sbin/gpsd", X_OK) != 0) GTEST_SKIP() << "no gpsd (Debian: gpsd)";
    const test::TemporaryFolder folder;
    NmeaPlan plan = plan_in(folder);
    plan.settings.rate_hz = 10;
    NmeaOutput output{plan};
    const int port = 20'000 + ::getpid() % 20'000;
    const Gpsd gpsd{plan.settings.link, port};
    const auto tell = [&] {
        Pose pose = pose_of_shuttle();
        pose.estimate.time = monotonic_now();
        output.take(pose);
        output.run(monotonic_now());
    };
    UniqueFd client;
    if (!test::eventually([&] { return tell(), (client = call_gpsd(port)) ? true : false; }))
        GTEST_SKIP() << "gpsd does not come up here";
    const auto position = first_position(client.get(), tell);
    ASSERT_TRUE(position.has_value());
    const auto& at = *position; // NOLINT(bugprone-unchecked-optional-access): the line above
    const Geodetic place{at["lat"], at["lon"], at.value("altHAE", 0.0)};
    EXPECT_LT((ecef_m(place) - SiteOnEarth{depot}.ecef_m({100, -20, 3})).norm(), 0.05);
    EXPECT_NEAR(at.value("speed", 0.0), 3, 0.01);
    EXPECT_NEAR(at.value("track", 0.0), 40, 0.05);
}

} // namespace
} // namespace locus
