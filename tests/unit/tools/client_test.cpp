// What a client makes of a daemon that is not there, is somebody else, or misbehaves.
#include "tests/unit/tools/fake_daemon.h"

#include "tools/client/client.h"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <chrono>
#include <fstream>

namespace locus {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using tools::Client;
using tools::DaemonError;

constexpr const char* status_line = "{\"class\":\"STATUS\",\"working\":true}\n";

std::string failure(const std::string& path, std::chrono::milliseconds patience = 5s) {
    try {
        Client client(path, patience);
    } catch (const DaemonError& error) {
        return error.what();
    }
    return "no failure";
}

std::string failure_of_asking(FakeDaemon::Answers answers, std::chrono::milliseconds patience = 5s) {
    const FakeDaemon daemon(answers);
    try {
        Client client(daemon.path(), patience);
        client.ask("?STATUS;", "STATUS");
    } catch (const DaemonError& error) {
        return error.what();
    }
    return "no failure";
}

TEST(Client, SaysWhatToDoWhenNoDaemonRuns) {
    const auto result = run_client({"status", "--socket", "/nowhere/locusd.sock"});
    EXPECT_EQ(result.exit_code, exit_no_daemon);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr("locusd is not running"));
    EXPECT_THAT(result.err, HasSubstr("systemctl start locusd"));
    EXPECT_THAT(result.err, HasSubstr("--socket"));
}

TEST(Client, TellsASocketNobodyListensAtFromAPlainFile) {
    FakeDaemon daemon({});
    const std::string plain = daemon.folder() + "/plain", dead = daemon.folder() + "/dead";
    std::ofstream(plain) << "hello";
    EXPECT_THAT(failure(plain), HasSubstr("is not a socket"));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    dead.copy(address.sun_path, sizeof address.sun_path - 1);
    {
        const UniqueFd listener(::socket(AF_UNIX, SOCK_STREAM, 0));
        ASSERT_EQ(::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    }
    EXPECT_THAT(failure(dead), HasSubstr("locusd is not running"));
}

TEST(Client, NamesTheGroupWhenPermissionLacks) {
    const FakeDaemon daemon({});
    std::filesystem::permissions(daemon.folder(), std::filesystem::perms::owner_all);
    std::filesystem::permissions(daemon.path(), std::filesystem::perms::none);
    const bool root = ::geteuid() == 0;
    ASSERT_EQ(::seteuid(root ? 65534 : ::geteuid()), 0);
    const std::string sentence = failure(daemon.path());
    ASSERT_EQ(::seteuid(::getuid()), 0);
    EXPECT_THAT(sentence, HasSubstr("you are not in group locusd"));
}

TEST(Client, RefusesAPathThatIsTooLong) {
    EXPECT_THAT(failure("/" + std::string(200, 'x')), HasSubstr("a path has 1 to 107 characters"));
    EXPECT_THAT(failure(""), HasSubstr("a path has 1 to 107 characters"));
}

TEST(Client, RefusesWhoeverIsNotLocusd) {
    EXPECT_THAT(failure(FakeDaemon({}, "220 smtp ready\n").path()), HasSubstr("\"220 smtp ready\" is no line"));
    EXPECT_THAT(failure(FakeDaemon({}, "{\"class\":\"WATCH\"}\n").path()), HasSubstr("greets with WATCH"));
    EXPECT_THAT(failure(FakeDaemon({}, "[1,2]\n").path()), HasSubstr("is not locusd"));
    EXPECT_THAT(failure(FakeDaemon({}, "{\"class\":7}\n").path()), HasSubstr("is not locusd"));
    EXPECT_THAT(failure(FakeDaemon({}, "").path(), 50ms), HasSubstr("does not answer"));
}

TEST(Client, RefusesAnotherMajorVersion) {
    EXPECT_THAT(failure(FakeDaemon({}, "{\"class\":\"VERSION\",\"protocol_major\":2}\n").path()),
                HasSubstr("version 2 of its protocol"));
}

TEST(Client, AnEscapeSequenceOfAStrangerDoesNotReachTheTerminal) {
    const auto sentence = failure(FakeDaemon({}, "\x1b[2Jboo\n").path());
    EXPECT_EQ(sentence.find('\x1b'), std::string::npos);
    EXPECT_THAT(sentence, HasSubstr("?[2Jboo"));
}

TEST(Client, RefusesALineWithoutEnd) {
    const FakeDaemon daemon({}, std::string(tools::Connection::max_line_bytes + (1u << 20), 'x'));
    try {
        Client client(daemon.path());
        FAIL();
    } catch (const DaemonError& error) {
        EXPECT_THAT(error.what(), HasSubstr("a line of more than"));
    }
}

TEST(Client, SeesTheDaemonCloseInsteadOfAnswering) {
    EXPECT_THAT(failure_of_asking({}), HasSubstr("closed the connection"));
}

TEST(Client, GivesUpOnAnAnswerThatDoesNotCome) {
    EXPECT_THAT(failure_of_asking({{"?STATUS", "{\"class\":\"POSE\"}\n{\"class\":"}}, 50ms),
                HasSubstr("does not answer"));
}

TEST(Client, RefusesAnAnswerThatIsNoJson) {
    EXPECT_THAT(failure_of_asking({{"?STATUS", "{\"class\":\"STATUS\",\n"}}), HasSubstr("is not locusd"));
}

TEST(Client, PutsLinesTogetherThatComeByteByByte) {
    const FakeDaemon daemon({{"?STATUS", std::string("{\"class\":\"POSE\"}\n") + status_line}}, FakeDaemon::greeting,
                            1);
    Client client(daemon.path());
    EXPECT_EQ(client.ask("?STATUS;", "STATUS").line + "\n", status_line);
}

// Any value in the place of any other: the commands show what they understand and never fall.
rc::Gen<nlohmann::json> any_json() {
    return rc::gen::element<nlohmann::json>(nullptr, true, -1e308, 7, "x\x1b", nlohmann::json::array(),
                                            nlohmann::json::array({1, "a", nullptr}), nlohmann::json::object(),
                                            nlohmann::json{{"name", 3}, {"counters", "many"}}, "\xc3");
}

TEST(Client, CommandsStandAnyValueInAnyField) {
    EXPECT_TRUE(rc::check([] {
        const auto line = [](const char* name, std::initializer_list<const char*> keys) {
            nlohmann::json fields{{"class", name}};
            for (const char* key : keys)
                fields[key] =
                    *rc::gen::oneOf(any_json(), rc::gen::map(any_json(), [](const nlohmann::json& item) {
                                        return nlohmann::json::array(
                                            {item, nlohmann::json{{"name", item}, {"refused", {{"r", item}}}}});
                                    }));
            return fields.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
        };
        const std::string watch = "{\"class\":\"WATCH\"}\n";
        const FakeDaemon daemon(
            {{"?STATUS", line("STATUS", {"working", "missing", "tick_late_us", "engine", "uptime_s", "config"})},
             {"?SOURCES", line("SOURCES", {"sources", "inputs"})},
             {"?TARGETS", line("TARGETS", {"targets"})},
             {"?WATCH", watch + line("POSE", {"target", "time", "position_site_m", "velocity_site_mps", "kinds_used",
                                              "horizontal_error_95_m"})}});
        for (const char* command : {"status", "sources", "targets"})
            RC_ASSERT(run_client({command, "--socket", daemon.path()}).exit_code <= exit_no);
        RC_ASSERT(run_client({"watch", "--count", "1", "--socket", daemon.path()}).exit_code == exit_yes);
        RC_ASSERT(run_client({"wait", "--better-than", "1", "--timeout", "0", "--socket", daemon.path()}).exit_code <=
                  exit_no);
    }));
}

} // namespace
} // namespace locus
