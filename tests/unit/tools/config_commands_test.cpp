// locus check, config and completion.
#include "tests/unit/tools/fake_daemon.h"
#include "tools/completion.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>

namespace locus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;

class SettingsFile {
  public:
    explicit SettingsFile(const std::string& text) { std::ofstream(path_) << text; }
    ~SettingsFile() { std::remove(path_.c_str()); }
    SettingsFile(const SettingsFile&) = delete;
    SettingsFile& operator=(const SettingsFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_ = testing::TempDir() + "locus_settings_" + std::to_string(::getpid()) + ".yaml";
};

CommandResult run(std::vector<std::string> words) {
    return run_locus({add_check, add_config, add_completion}, std::move(words));
}

TEST(Check, GoodFile) {
    const SettingsFile file("targets: [{name: cart, address: 3}]\n");
    const auto result = run({"check", file.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_EQ(result.out, file.path() + ": good: 0 anchors, 1 target, 0 inputs\n");
}

TEST(Check, EveryProblemWithItsPlace) {
    const SettingsFile file("log: {level: loud}\nfusoin: {}\n");
    const auto result = run({"check", file.path()});
    EXPECT_EQ(result.exit_code, exit_no);
    EXPECT_THAT(result.err, HasSubstr(file.path() + ":1:14: level cannot be \"loud\""));
    EXPECT_THAT(result.err, HasSubstr(file.path() + ":2:1: the file has no setting \"fusoin\""));
}

TEST(Check, WaitsForNoPipe) {
    const std::string pipe = testing::TempDir() + "locus_pipe_" + std::to_string(::getpid());
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const SettingsFile file("inputs: [{name: a, transport: fifo, path: " + pipe + ", decoder: trek1000}]\n");
    EXPECT_EQ(run({"check", file.path()}).exit_code, exit_yes);
    EXPECT_THAT(run({"check", pipe}).err, HasSubstr("the file is empty"));
    std::remove(pipe.c_str());
}

TEST(Check, Json) {
    const SettingsFile file("log: {level: loud}\n");
    const auto result = run({"check", "--json", file.path()});
    EXPECT_EQ(result.exit_code, exit_no);
    const auto answer = nlohmann::json::parse(result.out);
    EXPECT_FALSE(answer.at("ok").get<bool>());
    EXPECT_EQ(answer.at("problems").at(0).at("line"), 1);
    EXPECT_EQ(answer.at("problems").at(0).at("column"), 14);
}

TEST(Check, FileThatIsNotThere) {
    const auto result = run({"check", "/nonexistent.yaml"});
    EXPECT_EQ(result.exit_code, exit_usage);
    EXPECT_EQ(result.err, "/nonexistent.yaml: there is no such file\n");
}

TEST(Config, PrintsDefaults) {
    const SettingsFile file("log: {level: error}\n");
    const auto result = run({"config", "--print", file.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_THAT(result.out, HasSubstr("log:\n  level: \"error\"\n"));
    EXPECT_THAT(result.out, HasSubstr("  rate_hz: 100\n"));
}

TEST(Config, ReferenceNeedsNoFile) {
    const auto result = run({"config", "--reference"});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_THAT(result.out, HasSubstr("# Settings"));
}

/// What bash offers when the cursor stands behind `line`.
std::vector<std::string> completed_by_bash(const std::string& line) {
    CLI::App app("locus");
    int exit_code = 0;
    for (const auto add : {add_check, add_config, add_completion}) add(app, exit_code);
    const SettingsFile script(tools::bash_completion(app) + "COMP_WORDS=(" + line +
                              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _locus; echo \"${COMPREPLY[@]}\"\n");
    const std::string command = "bash " + script.path();
    std::FILE* output = ::popen(command.c_str(), "r");
    std::vector<std::string> words;
    std::array<char, 256> word{};
    while (std::fscanf(output, "%255s", word.data()) == 1) words.emplace_back(word.data());
    ::pclose(output);
    return words;
}

TEST(Completion, BashKnowsEveryCommandAndOption) {
    EXPECT_THAT(completed_by_bash("locus c"), ElementsAre("check", "config", "completion"));
    EXPECT_THAT(completed_by_bash("locus ''"), IsSupersetOf({"check", "config", "--help"}));
    EXPECT_THAT(completed_by_bash("locus check --j"), ElementsAre("--json"));
    EXPECT_THAT(completed_by_bash("locus config some.yaml --"), ElementsAre("--help", "--print", "--reference"));
    EXPECT_THAT(completed_by_bash("locus check hall"), ElementsAre());
}

TEST(Completion, ZshItemsAreQuoted) {
    CLI::App app("locus");
    app.add_subcommand("odd", "what: the daemon's own");
    EXPECT_THAT(tools::zsh_completion(app), HasSubstr(R"('odd:what\: the daemon'\''s own')"));
}

TEST(Completion, OtherShellsAreRefused) { EXPECT_EQ(run({"completion", "fish"}).exit_code, exit_usage); }

} // namespace
} // namespace locus
