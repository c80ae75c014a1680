// The scanner against nlohmann's parser: what it takes for whole, that takes too, with the same members.
#include "drivers/wire/json_scan.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>

namespace locus::wire {
namespace {

using Kind = JsonValue::Kind;

struct Scanned {
    std::vector<JsonMember> members;
    bool whole = false;
};

Scanned scan(std::string_view text) {
    Scanned scanned;
    JsonObject object{text};
    for (JsonMember member; object.next(member);) scanned.members.push_back(member);
    scanned.whole = object.whole();
    return scanned;
}

TEST(JsonScan, GivesMembersWithTheirKinds) {
    const auto scanned = scan(R"( { "a" : -1.5 , "b":"x\"y", "c":[1,[2]], "d":{"e":{}}, "f":null, "g":true } )");
    ASSERT_TRUE(scanned.whole);
    const std::vector<std::pair<Kind, std::string_view>> expected{
        {Kind::number, "-1.5"},        {Kind::string, R"(x\"y)"}, {Kind::list, "[1,[2]]"},
        {Kind::object, R"({"e":{}})"}, {Kind::nothing, "null"},   {Kind::truth, "true"}};
    ASSERT_EQ(scanned.members.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(scanned.members[i].value.kind, expected[i].first) << i;
        EXPECT_EQ(scanned.members[i].value.text, expected[i].second) << i;
    }
    EXPECT_TRUE(scan("{}").whole);
}

TEST(JsonScan, ReadsNumbersAlsoInQuotesAndTheFirstOfAList) {
    const auto members = scan(R"({"a":7,"b":"-8.5","c":[9,10],"d":[],"e":"7x","f":300,"g":null})").members;
    EXPECT_EQ(members[0].value.number<int>(), 7);
    EXPECT_EQ(members[1].value.number<double>(), -8.5);
    EXPECT_FALSE(members[2].value.number<int>());
    EXPECT_EQ(members[2].value.first().number<int>(), 9);
    EXPECT_FALSE(members[3].value.first().number<int>());
    EXPECT_FALSE(members[4].value.number<int>());
    EXPECT_FALSE(members[5].value.number<std::uint8_t>());
    EXPECT_FALSE(members[6].value.first().number<int>());
}

TEST(JsonScan, WalksThroughLists) {
    const auto members = scan(R"({"a":[1, "2" ,[3,4], {"b":5}],"c":[],"d":[ ],"e":6})").members;
    const auto items = [](const JsonValue& value) {
        std::vector<std::string_view> texts;
        JsonList list{value};
        for (JsonValue item; list.next(item);) texts.push_back(item.text);
        return texts;
    };
    EXPECT_EQ(items(members[0].value), (std::vector<std::string_view>{"1", "2", "[3,4]", R"({"b":5})"}));
    for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(items(members[i].value).empty()) << i;
}

TEST(JsonScan, WhatIsNoObjectIsNotWhole) {
    for (const std::string_view text :
         {"", "[1]", "{", R"({"a"})", R"({"a":})", R"({"a":1,})", R"({,"a":1})", R"({"a":1 "b":2})", R"({"a":1}})",
          R"({"a":[1,]})", R"({"a":[1}})", R"({"a":"x})", "{\"a\":\"\n\"}", R"({"a":"\)", R"({"a":x})", R"({a:1})",
          R"({"a":{1:2}})"})
        EXPECT_FALSE(scan(text).whole) << text;
    EXPECT_TRUE(scan(R"({"a":)" + std::string(8, '[') + std::string(8, ']') + "}").whole);
    EXPECT_FALSE(scan(R"({"a":)" + std::string(10, '[') + std::string(10, ']') + "}").whole);
    EXPECT_FALSE(scan(R"({"a":)" + std::string(100'000, '[')).whole);
}

nlohmann::json any_value(int depth) {
    switch (*rc::gen::inRange(0, depth == 0 ? 5 : 7)) {
    case 0:
        return *rc::gen::arbitrary<int>();
    case 1:
        return *rc::gen::inRange(-1000, 1000) / 8.0;
    case 2:
        return *rc::gen::container<std::string>(rc::gen::inRange(' ', '~'));
    case 3:
        return *rc::gen::arbitrary<bool>();
    case 4:
        return nullptr;
    case 5:
        return nlohmann::json::array({any_value(depth - 1), any_value(depth - 1)});
    default:
        return {{"k", any_value(depth - 1)}, {"l", any_value(depth - 1)}};
    }
}

TEST(JsonScan, ReadsWhatALibraryWrites) {
    EXPECT_TRUE(rc::check([] {
        nlohmann::json object = nlohmann::json::object();
        for (char name = 'a'; name < 'e'; ++name) object[std::string{name}] = any_value(3);
        const std::string text = object.dump(*rc::gen::inRange(-1, 3));
        const auto scanned = scan(text);
        RC_ASSERT(scanned.whole);
        RC_ASSERT(scanned.members.size() == object.size());
        for (const JsonMember& member : scanned.members) {
            const auto quoted = member.value.kind == Kind::string ? '"' + std::string{member.value.text} + '"'
                                                                  : std::string{member.value.text};
            RC_ASSERT(nlohmann::json::parse(quoted) == object[std::string{member.name}]);
        }
    }));
}

} // namespace
} // namespace locus::wire
