#include "daemon/socket/command.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace locus {
namespace {

Command good(std::string_view text) {
    const ParsedCommand parsed = parse_command(text);
    EXPECT_TRUE(std::holds_alternative<Command>(parsed)) << text << ": " << std::get<BadCommand>(parsed).message;
    return std::get<Command>(parsed);
}

std::string bad(std::string_view text) {
    const ParsedCommand parsed = parse_command(text);
    EXPECT_TRUE(std::holds_alternative<BadCommand>(parsed)) << text;
    return std::holds_alternative<BadCommand>(parsed) ? std::get<BadCommand>(parsed).message : "";
}

TEST(Command, EveryVerbIsUnderstood) {
    EXPECT_EQ(good("?WATCH").verb, Verb::watch);
    EXPECT_EQ(good("?POLL").verb, Verb::poll);
    EXPECT_EQ(good("?SOURCES").verb, Verb::sources);
    EXPECT_EQ(good("?TARGETS").verb, Verb::targets);
    EXPECT_EQ(good(" \n?STATUS ").verb, Verb::status);
    EXPECT_EQ(good("?RELOAD").verb, Verb::reload);
}

TEST(Command, SmoothedPosesAreForThoseWhoAsk) {
    EXPECT_FALSE(good(R"(?WATCH={"enable":true})").watch->wants_smoothed("a"));
    const Watch watch = *good(R"(?WATCH={"smoothed":true,"poses":false,"targets":["a"]})").watch;
    EXPECT_TRUE(watch.wants_smoothed("a"));
    EXPECT_FALSE(watch.wants_smoothed("b"));
    EXPECT_FALSE(watch.wants("a"));
    EXPECT_NE(bad(R"(?WATCH={"smoothed":1})").find("smoothed"), std::string::npos);
}

TEST(Command, WatchTakesItsOptionsAndPassesOverOthers) {
    const Watch watch = *good(R"(?WATCH={"targets":["a","b"],"rate_hz":5,"json":true})").watch;
    EXPECT_TRUE(watch.enable);
    EXPECT_TRUE(watch.poses);
    EXPECT_DOUBLE_EQ(watch.rate_hz, 5);
    EXPECT_TRUE(watch.wants("a"));
    EXPECT_FALSE(watch.wants("c"));
    EXPECT_FALSE(good("?WATCH").watch.has_value());
    EXPECT_FALSE(good(R"(?WATCH={"enable":false})").watch->wants("a"));
    EXPECT_FALSE(good(R"(?WATCH={"poses":false})").watch->wants("a"));
}

TEST(Command, WhatIsWrongIsSaid) {
    EXPECT_NE(bad("?WACH").find("unknown command \"?WACH\""), std::string::npos);
    EXPECT_NE(bad("?WATCH={\"enable\":1}").find("\"enable\" is true or false"), std::string::npos);
    EXPECT_NE(bad("?WATCH={\"rate_hz\":0}").find("rate_hz"), std::string::npos);
    EXPECT_NE(bad("?WATCH={\"rate_hz\":1e400}").find("JSON"), std::string::npos);
    EXPECT_NE(bad("?WATCH={\"targets\":[1]}").find("list of names"), std::string::npos);
    EXPECT_NE(bad("?WATCH={\"targets\":[]}").find("list of names"), std::string::npos);
    EXPECT_NE(bad("?WATCH=[]").find("JSON object"), std::string::npos);
    EXPECT_NE(bad("?WATCH={").find("JSON object"), std::string::npos);
    EXPECT_NE(bad("?POLL=1").find("takes no '='"), std::string::npos);
    EXPECT_NE(bad("\x1b[2J").find("\"?[2J\""), std::string::npos) << "nothing that moves a cursor comes back";
}

TEST(CommandReader, PutsPiecesTogether) {
    CommandReader reader;
    reader.feed("\r\n?STA");
    EXPECT_FALSE(reader.next());
    reader.feed("TUS;\n;;?POLL;?SO");
    EXPECT_EQ(std::get<Command>(*reader.next()).verb, Verb::status);
    EXPECT_EQ(std::get<Command>(*reader.next()).verb, Verb::poll);
    EXPECT_FALSE(reader.next());
}

TEST(CommandReader, AnOverlongCommandIsAnsweredOnceAndPassedOver) {
    CommandReader reader;
    std::size_t errors = 0;
    for (int i = 0; i < 100; ++i) {
        reader.feed(std::string(1000, 'x'));
        while (const auto parsed = reader.next()) errors += std::holds_alternative<BadCommand>(*parsed);
        ASSERT_LE(reader.buffered(), CommandReader::max_command + 1000);
    }
    EXPECT_EQ(errors, 1u);
    reader.feed("xx;?POLL;");
    EXPECT_EQ(std::get<Command>(*reader.next()).verb, Verb::poll);
}

RC_GTEST_PROP(CommandReader, AnyCutOfTheStreamGivesTheSameCommands, ()) {
    const std::string stream = "?POLL;\n?WATCH={\"rate_hz\":2};;?NO;  ?STATUS;?RELOAD;";
    const auto pieces = *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 9));
    CommandReader reader;
    std::vector<std::size_t> kinds;
    const auto drain = [&] {
        while (const auto parsed = reader.next())
            kinds.push_back(parsed->index() == 0 ? static_cast<std::size_t>(std::get<Command>(*parsed).verb) : 99);
    };
    std::size_t at = 0;
    for (const std::size_t piece : pieces) {
        reader.feed(std::string_view{stream}.substr(std::min(at, stream.size()), piece));
        at += piece;
        drain();
    }
    reader.feed(std::string_view{stream}.substr(std::min(at, stream.size())));
    drain();
    RC_ASSERT(kinds == (std::vector<std::size_t>{1, 0, 99, 4, 5}));
}

} // namespace
} // namespace locus
