// A client of the socket for tests: blocking, with a deadline, lines as JSON.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace locus::test {

using std::chrono::steady_clock;

/// Long, because nothing is proved by a short one; only a broken daemon waits for it.
inline constexpr std::chrono::seconds patience{20};

template <class Condition>
bool eventually(Condition condition) {
    const auto deadline = steady_clock::now() + patience;
    while (!condition()) {
        if (steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
    return true;
}

class SocketClient {
  public:
    explicit SocketClient(const std::string& path) : fd_{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::ranges::copy(path, address.sun_path);
        connected_ = eventually(
            [&] { return ::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0; });
    }

    bool connected() const { return connected_; }
    int fd() const { return fd_.get(); }

    bool say(std::string_view text) const {
        return ::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
    }
    void say_no_more() const { ::shutdown(fd_.get(), SHUT_WR); }

    /// The next line; empty when the connection ended or nothing came for a long time.
    std::optional<std::string> line() {
        for (;;) {
            if (const auto end = buffer_.find('\n'); end != std::string::npos) {
                std::string line = buffer_.substr(0, end);
                buffer_.erase(0, end + 1);
                return line;
            }
            if (!fill()) return {};
        }
    }

    /// The next line of that class; an empty object when there was none.
    nlohmann::json next(std::string_view class_name) {
        while (const auto text = line()) {
            auto object = nlohmann::json::parse(*text, nullptr, false);
            if (object.is_object() && object["class"] == class_name) return object;
        }
        return nlohmann::json::object();
    }

    nlohmann::json ask(std::string_view command, std::string_view class_name) {
        return say(command) ? next(class_name) : nlohmann::json::object();
    }

    /// The newest pose of every target that has one. All lines are taken: what is left would answer the next question.
    std::vector<nlohmann::json> poll() {
        std::vector<nlohmann::json> poses;
        say("?POLL;");
        while (const auto text = line()) {
            auto object = nlohmann::json::parse(*text, nullptr, false);
            if (object.value("class", "") == "POLL") break;
            if (object.value("class", "") == "POSE") poses.push_back(std::move(object));
        }
        return poses;
    }

    /// Waits until the other side closes.
    bool sees_the_end() {
        while (fill()) buffer_.clear();
        return ended_;
    }

  private:
    bool fill() {
        pollfd poll{fd_.get(), POLLIN, 0};
        const auto wait = std::chrono::duration_cast<std::chrono::milliseconds>(patience).count();
        if (::poll(&poll, 1, static_cast<int>(wait)) <= 0) return false;
        char bytes[65536];
        const ssize_t got = ::recv(fd_.get(), bytes, sizeof bytes, 0);
        ended_ = got <= 0;
        if (got > 0) buffer_.append(bytes, static_cast<std::size_t>(got));
        return got > 0;
    }

    UniqueFd fd_;
    bool connected_ = false;
    bool ended_ = false;
    std::string buffer_;
};

} // namespace locus::test
