// The publisher with real sockets, its rings filled by the test.
#include "daemon/socket/publisher.h"

#include "tests/support/socket_client.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <list>

namespace locus {
namespace {

using test::SocketClient;

class PublisherTest : public ::testing::Test {
  protected:
    PublisherTest() : publisher_{Listener::bind(path_), output_, ticked_, post_, roster(4, 64)} {
        thread_ = std::jthread{[this](const std::stop_token& stop) { publisher_.run(stop); }};
    }

    static std::unique_ptr<const Roster> roster(int clients, int queue) {
        Roster roster;
        roster.site = "hall";
        roster.publish.max_clients = clients;
        roster.publish.client_queue = queue;
        return std::make_unique<const Roster>(std::move(roster));
    }

    void replace_roster(int clients, int queue) {
        auto next = roster(clients, queue);
        ASSERT_TRUE(post_.rosters.give(next));
        post_.publisher.raise();
    }

    /// One tick with a pose of target 0x1 at x = tick.
    void tick(std::int64_t number) {
        PoseItem item;
        item.generation = 1;
        item.pose.target = address(1);
        item.pose.estimate.missing = Missing::nothing;
        item.pose.estimate.time = timestamp_from_ns(number * 10'000'000);
        item.pose.estimate.position_site_m = {static_cast<double>(number), 0, 0};
        while (!output_.poses.push(item)) std::this_thread::yield();
        ticked_.raise();
    }

    std::string path_ = ::testing::TempDir() + "locusd-publisher-" + std::to_string(::getpid()) + ".sock";
    FusionOutput output_;
    Wake ticked_;
    Post post_;
    Publisher publisher_;
    std::jthread thread_;
};

double x_of(const nlohmann::json& pose) { return pose["position_site_m"][0]; }

TEST_F(PublisherTest, GreetsAndStreamsToWhoeverWatches) {
    SocketClient client{path_};
    EXPECT_EQ(client.next("VERSION")["site"], "hall");
    EXPECT_EQ(client.ask("?WATCH={};", "WATCH")["enable"], true);
    tick(1);
    tick(2);
    EXPECT_EQ(x_of(client.next("POSE")), 1);
    const auto second = client.next("POSE");
    EXPECT_EQ(x_of(second), 2);
    EXPECT_EQ(second["target"], "0x1");
    EXPECT_FALSE(second.contains("dropped"));
    EXPECT_EQ(x_of(client.ask("?POLL;", "POSE")), 2);
    EXPECT_EQ(client.next("POLL")["poses"], 1);
}

TEST_F(PublisherTest, GivesWhatRadiosHeardToWhoAsksForIt) {
    SocketClient surveyor{path_}, watcher{path_};
    watcher.ask("?WATCH={};", "WATCH");
    EXPECT_EQ(surveyor.ask(R"(?WATCH={"readings":true,"poses":false,"targets":["0x1"]};)", "WATCH")["readings"], true);
    output_.readings.push({timestamp_from_s(2), address(2), address(0x90), -70});
    output_.readings.push({timestamp_from_s(2.5), address(1), address(0x91), -61.5F});
    tick(1);
    const auto reading = surveyor.next("READING");
    EXPECT_EQ(reading["target"], "0x1");
    EXPECT_EQ(reading["beacon"], "0x91");
    EXPECT_EQ(reading["rssi_dbm"], -61.5);
    EXPECT_EQ(reading["time"], 2.5);
    EXPECT_NE(watcher.line().value_or("").find("POSE"), std::string::npos) << "and to nobody else";
}

TEST_F(PublisherTest, TheSocketIsForTheGroupAndGoesWithThePublisher) {
    struct stat status{};
    ASSERT_EQ(::stat(path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0660U);
}

TEST_F(PublisherTest, OneThatDoesNotReadLosesItsOldestPosesAndDelaysNobody) {
    SocketClient slow{path_}, quick{path_};
    slow.ask("?WATCH={};", "WATCH");
    quick.ask("?WATCH={};", "WATCH");
    constexpr int ticks = 3000;
    for (int i = 1; i <= ticks; ++i) {
        tick(i);
        ASSERT_EQ(x_of(quick.next("POSE")), i);
    }
    double last = 0;
    int dropped = 0;
    while (last < ticks) {
        const auto pose = slow.next("POSE");
        ASSERT_TRUE(pose.contains("position_site_m"));
        const int lost = pose.value("dropped", 0);
        ASSERT_EQ(x_of(pose), last + lost + 1) << "what is lost is told exactly";
        last = x_of(pose);
        dropped += lost;
    }
    EXPECT_GT(dropped, ticks / 2);
}

TEST_F(PublisherTest, NonsenseIsAnsweredAndTheConnectionStays) {
    SocketClient client{path_};
    const auto error = client.ask(std::string{"\xff\xfe\0?;", 5}, "ERROR");
    EXPECT_NE(error.dump().find("unknown command"), std::string::npos);
    EXPECT_TRUE(client.say(std::string(100'000, 'x')));
    EXPECT_EQ(client.ask(";?STATUS;", "STATUS")["clients"], 1);
}

TEST_F(PublisherTest, AFloodOfCommandsThatNobodyReadsIsHeldBackNotLost) {
    SocketClient flood{path_}, other{path_};
    constexpr int commands = 5000;
    std::thread talker{[&] {
        for (int i = 0; i < commands; ++i)
            if (!flood.say("?STATUS;")) break;
        flood.say_no_more();
    }};
    EXPECT_EQ(other.ask("?STATUS;", "STATUS")["class"], "STATUS") << "others are served meanwhile";
    int answers = 0;
    while (answers < commands && flood.next("STATUS").contains("class")) ++answers;
    talker.join();
    EXPECT_EQ(answers, commands);
}

TEST_F(PublisherTest, AClientThatVanishesLeavesNoTrace) {
    for (int i = 0; i < 20; ++i) {
        SocketClient client{path_};
        client.ask("?WATCH={};", "WATCH");
    }
    SocketClient last{path_};
    last.ask("?WATCH={};", "WATCH");
    tick(1);
    EXPECT_EQ(x_of(last.next("POSE")), 1);
    EXPECT_TRUE(test::eventually([&] { return last.ask("?STATUS;", "STATUS")["clients"] == 1; }));
}

TEST_F(PublisherTest, OneTooManyIsToldSo) {
    std::list<SocketClient> clients;
    for (int i = 0; i < 4; ++i) clients.emplace_back(path_).next("VERSION");
    SocketClient fifth{path_};
    EXPECT_NE(fifth.next("ERROR").dump().find("too many clients"), std::string::npos);
    EXPECT_TRUE(fifth.sees_the_end());
}

TEST_F(PublisherTest, SixtyClientsGetEveryPose) {
    replace_roster(64, 64);
    std::list<SocketClient> clients;
    for (int i = 0; i < 60; ++i) clients.emplace_back(path_).ask("?WATCH={};", "WATCH");
    for (int i = 1; i <= 20; ++i) tick(i);
    for (auto& client : clients)
        for (int i = 1; i <= 20; ++i) ASSERT_EQ(x_of(client.next("POSE")), i);
}

TEST_F(PublisherTest, RateAndTargetsAreHeeded) {
    SocketClient thinned{path_}, elsewhere{path_}, all{path_};
    thinned.ask(R"(?WATCH={"rate_hz":10};)", "WATCH");
    elsewhere.ask(R"(?WATCH={"targets":["nobody"]};)", "WATCH");
    all.ask("?WATCH={};", "WATCH");
    for (int i = 100; i < 200; ++i) tick(i);
    while (x_of(all.next("POSE")) < 199) {
    }
    for (int i = 0; i < 10; ++i) EXPECT_EQ(x_of(thinned.next("POSE")), 100 + 10 * i);
    elsewhere.say("?STATUS;");
    EXPECT_EQ(nlohmann::json::parse(*elsewhere.line())["class"], "STATUS") << "no pose came before it";
}

TEST_F(PublisherTest, OneThatHasSaidAllStillReads) {
    SocketClient client{path_};
    client.say("?STATUS;?WATCH={};");
    client.say_no_more();
    EXPECT_EQ(client.next("STATUS")["class"], "STATUS");
    EXPECT_EQ(client.next("WATCH")["class"], "WATCH");
    tick(1);
    EXPECT_EQ(x_of(client.next("POSE")), 1);
}

TEST_F(PublisherTest, ReloadGoesToTheMainThreadAndItsAnswerToWhoAsked) {
    SocketClient client{path_};
    client.next("VERSION");
    client.say("?RELOAD;");
    ReloadRequest request;
    ASSERT_TRUE(test::eventually([&] { return post_.requests.pop(request); }));
    auto answer = std::make_unique<const ReloadAnswer>(ReloadAnswer{request.client, false, {"a.yaml:1:1: no"}});
    ASSERT_TRUE(post_.answers.give(answer));
    post_.publisher.raise();
    const auto told = client.next("RELOAD");
    EXPECT_EQ(told["ok"], false);
    EXPECT_EQ(told["problems"][0], "a.yaml:1:1: no");
}

TEST(Listener, ReplacesAFileThatNobodyListensAtAndNothingElse) {
    const std::string path = ::testing::TempDir() + "locusd-listener-" + std::to_string(::getpid()) + ".sock";
    {
        const Listener first = Listener::bind(path);
        EXPECT_THROW(Listener::bind(path), std::runtime_error) << "somebody listens";
        std::filesystem::rename(path, path + ".left");
    }
    std::filesystem::rename(path + ".left", path);
    EXPECT_NO_THROW(Listener::bind(path)) << "left behind by a daemon that was killed";
    EXPECT_FALSE(std::filesystem::exists(path)) << "removed at the end";
    EXPECT_THROW(Listener::bind("/nowhere/at/all.sock"), std::runtime_error);
    EXPECT_THROW(Listener::bind(std::string(200, 'x')), std::runtime_error);
    EXPECT_THROW(Listener::bind("/dev/null"), std::runtime_error);
}

} // namespace
} // namespace locus
