// locusd as a process, with its own folder, configuration and socket.
#pragma once

#include "tests/support/fake_device.h"
#include "tests/support/temporary_folder.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace locus::test {

class DaemonProcess {
  public:
    /// `prepare` runs in the child before it becomes locusd.
    explicit DaemonProcess(
        std::vector<std::string> arguments, const std::string& log, const std::function<void()>& prepare = [] {})
        : pid_{::fork()} {
        if (pid_ != 0) return;
        prepare();
        const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
        ::dup2(out, STDOUT_FILENO);
        ::dup2(out, STDERR_FILENO);
        arguments.insert(arguments.begin(), LOCUSD);
        std::vector<char*> argv;
        for (auto& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        ::execv(LOCUSD, argv.data());
        ::_exit(127);
    }
    ~DaemonProcess() {
        if (pid_ < 0) return;
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    DaemonProcess(const DaemonProcess&) = delete;
    DaemonProcess& operator=(const DaemonProcess&) = delete;

    void signal(int number) const { ::kill(pid_, number); }

    pid_t pid() const { return pid_; }

    /// Exit code; 128 and the signal's number when one killed it; empty when it still runs.
    std::optional<int> exit_code() {
        int status = 0;
        if (pid_ < 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return {};
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t pid_;
};

inline std::string read_all(const std::string& path) {
    std::ifstream stream{path};
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_all(const std::string& path, const std::string& text) { std::ofstream{path} << text; }

} // namespace locus::test
