#include "drivers/recording/measurement_json.h"

#include "tests/unit/drivers/recording/measurement_gen.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus {
namespace {

std::string why_not(std::string_view line) {
    std::string error;
    EXPECT_FALSE(from_json_line(line, error)) << line;
    return error;
}

TEST(MeasurementJson, EveryKindComesBackToTheBit) {
    EXPECT_TRUE(rc::check([] {
        const Measurement measurement = test::random_measurement();
        const std::string line = to_json_line(measurement);
        std::string error;
        const auto back = from_json_line(line, error);
        if (!back) RC_FAIL(error + " in " + line);
        RC_ASSERT(test::same_bits(measurement, *back));
    }));
}

TEST(MeasurementJson, LineIsAsDocumented) {
    const Measurement measurement{timestamp_from_ns(12'000'000'345), 7, 2,
                                  Range{address(1), address(0), 2.5, 0.1f, unknown_f, -90.f, LineOfSight::blocked}};
    EXPECT_EQ(to_json_line(measurement),
              R"({"t":12.000000345,"class":"RANGE","input":2,"sequence":7,"anchor":1,"tag":0,"range_m":2.5,)"
              R"("sigma_m":0.1,"first_path_power_dbm":-90,"line_of_sight":"blocked"})");
}

TEST(MeasurementJson, ReadsWhatAScriptWrites) {
    std::string error;
    const auto read = from_json_line(
        R"( {"class": "RANGE_DIFFERENCE", "t": 0.30000000000000004, "sequence": 0, "input": 0, "anchor_a": 1,
             "anchor_b": 2, "tag": 3, "difference_m": -1} )",
        error);
    ASSERT_TRUE(read) << error;
    EXPECT_EQ(to_ns(read->time), 300'000'000);
    const auto& difference = std::get<RangeDifference>(read->observation);
    EXPECT_EQ(difference.difference_m, -1);
    EXPECT_TRUE(std::isnan(difference.sigma_m));
}

TEST(MeasurementJson, NeverWritesWhatIsNotFinite) {
    const Measurement measurement{timestamp_from_ns(0), 0, 0, Range{address(1), address(2), std::nan("")}};
    const std::string line = to_json_line(measurement);
    EXPECT_EQ(line.find("nan"), line.npos);
    EXPECT_EQ(why_not(line), R"("range_m" is missing)");
}

TEST(MeasurementJson, SaysInASentenceWhatIsWrong) {
    const std::string head = R"({"t":1,"input":0,"sequence":0,"class":"RANGE")";
    const auto why = [&](const std::string& rest) { return why_not(head + rest + "}"); };
    EXPECT_EQ(why(R"(,"anchor":1,"range_m":2)"), R"("tag" is missing)");
    EXPECT_EQ(why(R"(,"anchor":-1,"tag":0,"range_m":2)"),
              R"("anchor" must be a whole number from 0 to 18446744073709551615)");
    EXPECT_EQ(why(R"(,"anchor":18446744073709551616,"tag":0,"range_m":2)"),
              R"("anchor" must be a whole number from 0 to 18446744073709551615)");
    EXPECT_EQ(why(R"(,"anchor":1,"tag":0,"range_m":"2")"), R"("range_m" must be a finite number)");
    EXPECT_EQ(why(R"(,"anchor":1,"tag":0,"range_m":null)"), R"("range_m" must be a finite number)");
    EXPECT_EQ(why(R"(,"anchor":1,"tag":0,"range_m":2,"rnage":3)"), R"("rnage" is not a field of this class)");
    EXPECT_EQ(why(R"(,"anchor":1,"anchor":1)"), R"("anchor" is there twice)");
    EXPECT_EQ(why(R"(,"anchor":1,"tag":0,"range_m":2,"line_of_sight":"yes")"),
              R"("line_of_sight" must be "clear", "blocked" or "unknown")");
    EXPECT_EQ(why(R"(,"anchor":1,"tag":0,"range_m":2,"sigma_m":1e60)"), R"("sigma_m" must be a finite number)");
    EXPECT_EQ(why_not(R"({"t":1,"input":70000,"sequence":0,"class":"RANGE"})"),
              R"("input" must be a whole number from 0 to 65535)");
    EXPECT_EQ(why_not(R"({"t":1,"input":0,"sequence":0,"class":"RADAR"})"),
              R"("class" is "RADAR", which is not a class of measurements)");
    EXPECT_EQ(why_not(R"({"t":1,"input":0,"sequence":0,"class":3})"), R"("class" must be a text)");
}

TEST(MeasurementJson, RefusesListsOfTheWrongLengthOrContent) {
    const std::string head = R"({"t":1,"input":0,"sequence":0,"class":"IMU","tag":0,"angular_rate_radps":[0,0,0],)";
    for (const char* list : {"[1,2]", "[1,2,3,4]", "[1,2,\"3\"]", "[1,[2],3]", "[1,{},3]", "5", "{\"x\":[1,2,3]}"})
        EXPECT_EQ(why_not(head + R"("specific_force_mps2":)" + list + "}"),
                  R"("specific_force_mps2" must be a list of 3 finite numbers)");
}

TEST(MeasurementJson, RefusesWordsThatAreNone) {
    const std::string head = R"({"t":1,"input":0,"sequence":0,"class":"GNSS_NAVIGATION","tag":0,"constellation":0,)"
                             R"("satellite":5,"signal":0,"glonass_slot":0,"word_count":10,"words":)";
    for (const char* list :
         {"[1,2]", "[4294967296,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]", "[-1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]",
          "[0.5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]", "\"22c0502e\""})
        EXPECT_EQ(why_not(head + list + "}"), R"("words" must be a list of 16 whole numbers)");
}

TEST(MeasurementJson, TakesLooksOnlyAsBytes) {
    const std::string head = R"({"t":1,"input":0,"sequence":0,"class":"FOOT_POINT","camera":0,"track":1,)"
                             R"("position_site_m":[1,2],"covariance_m2":[0.1,0,0.1])";
    const std::string zeros = ",0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0"; // one is missing
    for (const std::string& list :
         {"[0" + zeros + ",0]", std::string("[1,2]"), "[256" + zeros + "]", "[-1" + zeros + "]", "[0.5" + zeros + "]",
          "[1e2" + zeros + "]", std::string("\"red\"")})
        EXPECT_EQ(why_not(head + R"(,"looks":)" + list + "}"),
                  R"("looks" must be a list of 24 whole numbers from 0 to 255)");
    std::string error;
    const auto with = from_json_line(head + R"(,"looks":[255)" + zeros + "]}", error);
    ASSERT_TRUE(with.has_value()) << error;
    EXPECT_EQ(std::get<FootPoint>(with.value().observation).looks[0], 255);
    const auto old = from_json_line(head + R"(,"appearance_slot":3})", error);
    ASSERT_TRUE(old.has_value()) << error;
    EXPECT_EQ(std::get<FootPoint>(old.value().observation).looks, Looks{});
    EXPECT_EQ(to_json_line(old.value()).find("looks"), std::string::npos) << "nothing is known";
}

TEST(MeasurementJson, RefusesAbsurdTimes) {
    for (const char* time : {"9000000000", "-9e9", "99999999999999999999", "1e300", "\"1\"", "[1]", "true"})
        EXPECT_EQ(why_not(std::string(R"({"t":)") + time + R"(,"class":"RANGE","input":0,"sequence":0})"),
                  R"("t" must be a time in seconds, less than 9e9 from zero)");
}

TEST(MeasurementJson, RefusesWhatIsNoObject) {
    for (const char* line : {"", "[]", "[{}]", "5", "\"t\"", "null", "{", "{}{}", "{\"t\":1e999}", "{\"t\":nan}"}) {
        std::string error;
        EXPECT_FALSE(from_json_line(line, error)) << line;
        EXPECT_FALSE(error.empty()) << line;
    }
    EXPECT_EQ(why_not("[]"), "the line is not one JSON object");
    EXPECT_EQ(why_not("{\"t\":}"), "the line is not valid JSON at character 6");
    EXPECT_FALSE(why_not(std::string(100'000, '[')).empty());
    EXPECT_FALSE(why_not("{\"t\":" + std::string(100'000, '[')).empty());
}

} // namespace
} // namespace locus
