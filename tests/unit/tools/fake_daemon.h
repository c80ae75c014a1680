// A daemon that says what a test tells it to, on a socket of its own, and a way to run a command of locus against it.
#pragma once

#include "drivers/transport/unique_fd.h"
#include "tests/support/temporary_folder.h"
#include "tools/command.h"

#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <poll.h>

#include <atomic>
#include <initializer_list>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace locus {

class FakeDaemon {
  public:
    /// Text for each command ("?STATUS"); a command that is not here closes the connection.
    using Answers = std::initializer_list<std::pair<const std::string, std::string>>;

    static constexpr const char* greeting =
        R"({"class":"VERSION","release":"0.1.0","protocol_major":1,"protocol_minor":0,"site":"hall","rate_hz":100})"
        "\n";

    explicit FakeDaemon(Answers answers, std::string greets = greeting, std::size_t chunk_bytes = 1u << 20)
        : answers_(answers), greeting_(std::move(greets)), chunk_bytes_(chunk_bytes) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path_.copy(address.sun_path, sizeof address.sun_path - 1);
        listener_.reset(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
        if (::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
            ::listen(listener_.get(), 4) != 0)
            throw std::runtime_error("the test cannot listen at " + path_);
        thread_ = std::thread([this] { run(); });
    }

    ~FakeDaemon() {
        stop_ = true;
        thread_.join();
    }

    const std::string& path() const { return path_; }
    const std::string& folder() const { return folder_.path(); }

    std::vector<std::string> commands() const {
        const std::scoped_lock lock(mutex_);
        return commands_;
    }

  private:
    bool readable(int fd) const {
        while (!stop_) {
            pollfd poll{fd, POLLIN, 0};
            if (::poll(&poll, 1, 10) > 0) return true;
        }
        return false;
    }

    void run() {
        while (readable(listener_.get())) {
            const UniqueFd client(::accept(listener_.get(), nullptr, nullptr));
            send(client.get(), greeting_);
            serve(client.get());
        }
    }

    void serve(int client) {
        std::string command;
        while (readable(client)) {
            char byte = 0;
            if (::recv(client, &byte, 1, 0) != 1) return;
            if (byte == '\n') continue;
            command += byte;
            if (byte == ';' && !answer(client, std::exchange(command, {}))) return;
        }
    }

    bool answer(int client, const std::string& command) {
        {
            const std::scoped_lock lock(mutex_);
            commands_.push_back(command);
        }
        const auto found = answers_.find(command.substr(0, command.find_first_of("=;")));
        if (found != answers_.end()) send(client, found->second);
        return found != answers_.end();
    }

    void send(int client, const std::string& text) const {
        for (std::size_t at = 0; at < text.size() && !stop_; at += chunk_bytes_)
            if (::send(client, text.data() + at, std::min(chunk_bytes_, text.size() - at), MSG_NOSIGNAL) < 0) return;
    }

    std::map<std::string, std::string> answers_;
    std::string greeting_;
    std::size_t chunk_bytes_;
    test::TemporaryFolder folder_;
    std::string path_ = folder_ / "socket";
    UniqueFd listener_;
    std::atomic<bool> stop_ = false;
    mutable std::mutex mutex_;
    std::vector<std::string> commands_;
    std::thread thread_;
};

struct CommandResult {
    int exit_code = -1;
    std::string out;
    std::string err;
};

/// Runs `locus WORDS...` with the commands given, in this process.
inline CommandResult run_locus(std::initializer_list<AddCommand> commands, std::vector<std::string> words) {
    CLI::App app{"locus"};
    CommandResult result;
    for (const auto add : commands) add(app, result.exit_code);
    std::ranges::reverse(words);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        result.exit_code = app.exit(error) == 0 ? exit_yes : exit_usage;
    }
    std::cout.flush();
    std::fflush(stdout);
    result.out = testing::internal::GetCapturedStdout();
    result.err = testing::internal::GetCapturedStderr();
    return result;
}

inline CommandResult run_client(std::vector<std::string> words) {
    return run_locus({add_status, add_sources, add_targets, add_watch, add_wait, add_reload}, std::move(words));
}

} // namespace locus
