#include "tools/simulate/output.h"

#include "drivers/recording/log_line.h"
#include "drivers/transport/can_socket.h"
#include "drivers/transport/unique_fd.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <stdexcept>

namespace locus::simulate {
namespace {

/// An option of the input's transport by its name.
std::string transport_option(const InputSettings& input, std::string_view name) {
    for (const OptionRow& row : input.transport->options.rows)
        if (row.name == name) return std::get<std::string>(row.get(input.transport_settings.get()));
    return {};
}

[[noreturn]] void fail(const std::string& sentence) { throw std::runtime_error(sentence); }
[[noreturn]] void fail_with_errno(const std::string& sentence) { fail(sentence + ": " + std::strerror(errno)); }

bool write_whole(int fd, std::span<const std::uint8_t> bytes) {
    return ::write(fd, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

/// A link to a pseudo-terminal, gone with its maker. Only a link is ever replaced.
class DeviceLink {
  public:
    DeviceLink(const std::string& target, const std::string& path) : path_(path) {
        if (std::filesystem::is_symlink(std::filesystem::symlink_status(path))) std::filesystem::remove(path);
        if (::symlink(target.c_str(), path.c_str()) != 0) fail_with_errno("cannot make the link '" + path + "'");
    }
    DeviceLink(const DeviceLink&) = delete;
    DeviceLink& operator=(const DeviceLink&) = delete;
    ~DeviceLink() { ::unlink(path_.c_str()); }

  private:
    std::string path_;
};

UniqueFd open_master() {
    UniqueFd master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!master || ::grantpt(master.get()) != 0 || ::unlockpt(master.get()) != 0)
        fail_with_errno("cannot make a pseudo-terminal");
    return master;
}

/// Raw from the start, so that nothing is echoed. Opened and closed once: from then on poll() says whether a reader is
/// there (POLLHUP: none), and no stale bytes wait for one who comes late.
std::string prepare_slave(int master) {
    const std::string name = ::ptsname(master);
    const UniqueFd slave(::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios terminal{};
    if (!slave || ::tcgetattr(slave.get(), &terminal) != 0) fail_with_errno("cannot open the pseudo-terminal " + name);
    ::cfmakeraw(&terminal);
    ::tcsetattr(slave.get(), TCSANOW, &terminal);
    return name;
}

class PtyOutput : public Output {
  public:
    explicit PtyOutput(const std::string& path) : master_(open_master()), link_(prepare_slave(master_.get()), path) {}

    void packet(const Packet& packet) override { lost_ += !has_reader() || !write_whole(master_.get(), packet.data); }

    bool has_reader() override {
        pollfd state{master_.get(), POLLOUT, 0};
        return ::poll(&state, 1, 0) == 1 && !(state.revents & POLLHUP);
    }

  private:
    UniqueFd master_;
    DeviceLink link_;
};

class FifoOutput : public Output {
  public:
    explicit FifoOutput(std::string path) : path_(std::move(path)) {
        if (::mkfifo(path_.c_str(), 0660) != 0 && errno != EEXIST)
            fail_with_errno("cannot make the pipe '" + path_ + "'");
        if (!std::filesystem::is_fifo(path_)) fail("'" + path_ + "' is there already and is not a named pipe");
    }

    void packet(const Packet& packet) override {
        if (has_reader() && write_whole(fd_.get(), packet.data)) return;
        ++lost_;
        if (errno != EAGAIN) fd_.reset();
    }

    /// Without a reader a pipe cannot be opened; when the reader has gone, the next write fails and it is closed.
    bool has_reader() override {
        if (!fd_) fd_.reset(::open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
        return static_cast<bool>(fd_);
    }

  private:
    std::string path_;
    UniqueFd fd_;
};

class CanOutput : public Output {
  public:
    explicit CanOutput(const std::string& interface) {
        if (std::string error; !socket_.open(interface, error)) fail(error);
    }
    void packet(const Packet& packet) override { lost_ += !socket_.send(packet); }

  private:
    CanSocket socket_;
};

class Recorder : public Output {
  public:
    Recorder(std::string name, std::ostream& stream) : name_(std::move(name)), stream_(stream) {}
    void packet(const Packet& packet) override { stream_ << to_log_line(name_, packet) << '\n'; }

  private:
    std::string name_;
    std::ostream& stream_;
};

template <class Kind>
std::unique_ptr<Output> make(const std::string& device) {
    return std::make_unique<Kind>(device);
}

struct Device {
    std::string_view transport;
    std::string_view option;
    std::unique_ptr<Output> (*make)(const std::string& device);
};

constexpr std::array devices{
    Device{"pty", "path", make<PtyOutput>},
    Device{"fifo", "path", make<FifoOutput>},
    Device{"can", "interface", make<CanOutput>},
};

const Device* find_device(std::string_view transport) {
    const auto* const device = std::ranges::find(devices, transport, &Device::transport);
    return device == devices.end() ? nullptr : device;
}

} // namespace

std::string cannot_open(const InputSettings& input) {
    if (find_device(input.transport->name) != nullptr) return {};
    return "transport " + std::string(input.transport->name) + " cannot be fed from here: use pty, fifo or can";
}

std::unique_ptr<Output> make_output(const InputSettings& input) {
    const Device* const device = find_device(input.transport->name);
    return device->make(transport_option(input, device->option));
}

std::unique_ptr<Output> make_recorder(const InputSettings& input, std::ostream& stream) {
    return std::make_unique<Recorder>(input.name, stream);
}

} // namespace locus::simulate
