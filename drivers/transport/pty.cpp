// A pseudo-terminal that a simulator or socat made. It has no baud rate, and libserialport refuses it: it is no device
// of /sys/class/tty.
#include "drivers/transport/rows.h"
#include "drivers/transport/stream.h"

#include <termios.h>

#include <array>

namespace locus {
namespace {

struct PtySettings {
    std::string path;
};

constexpr std::array pty_options{
    required_option<&PtySettings::path>("path", "Pseudo-terminal, or a link to one, e.g. what `socat pty,link=` made."),
};

/// No echo, no line editing, no translation of bytes.
bool make_raw(int fd) {
    termios terminal{};
    if (::tcgetattr(fd, &terminal) != 0) return false;
    ::cfmakeraw(&terminal);
    return ::tcsetattr(fd, TCSANOW, &terminal) == 0;
}

class Pty : public StreamTransport {
  public:
    explicit Pty(const PtySettings& settings) : StreamTransport{settings.path} {}

    bool open() override {
        std::string error;
        fd_ = open_device(device_, "pseudo-terminal", error);
        if (!fd_) return refuse(error);
        if (make_raw(fd_.get())) return true;
        close();
        return refuse("'" + device_ + "' is not a pseudo-terminal: for a named pipe use transport: fifo");
    }
};

} // namespace

TransportRow pty_row() {
    return {"pty",
            "Pseudo-terminal, for simulators and socat.",
            Wire::bytes,
            false,
            option_table<PtySettings>(pty_options),
            [](const void* settings) -> std::unique_ptr<Transport> {
                return std::make_unique<Pty>(*static_cast<const PtySettings*>(settings));
            },
            "path"};
}

} // namespace locus
