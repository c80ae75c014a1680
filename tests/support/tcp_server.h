// A TCP server in place of ser2net, for one client at a time.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <arpa/inet.h>
#include <sys/socket.h>

#include <stdexcept>
#include <string>

namespace locus::test {

class TcpServer {
  public:
    TcpServer() : listener_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)} {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
            ::listen(listener_.get(), 4) != 0 ||
            ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("the test cannot listen on TCP");
        port_ = ntohs(address.sin_port);
    }

    int port() const { return port_; }

    /// To whoever is connected; nobody: it is lost. From one thread.
    void send(const std::string& bytes) const {
        if (UniqueFd next{::accept(listener_.get(), nullptr, nullptr)}) client_ = std::move(next);
        if (client_) ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }

  private:
    UniqueFd listener_;
    mutable UniqueFd client_;
    int port_ = 0;
};

} // namespace locus::test
