// A serial port, by libserialport: exclusive, raw, any baud rate. The path is resolved each time it is opened, so a
// /dev/serial/by-id/ name finds its device again after it was plugged in elsewhere.
#include "drivers/transport/rows.h"
#include "drivers/transport/stream.h"

#include <libserialport.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace locus {
namespace {

constexpr std::array<std::string_view, 3> parities{"none", "odd", "even"}; // in the order of sp_parity

struct SerialSettings {
    std::string path;
    int baud_bd = 115200;
    int data_bits = 8;
    std::string parity = "none";
    int stop_bits = 1;
};

constexpr std::array serial_options{
    required_option<&SerialSettings::path>("path",
                                           "Device; a name of /dev/serial/by-id/ stays the same when replugged."),
    option<&SerialSettings::baud_bd>("baud_bd", "Bd", 50, 4'000'000, "Baud rate."),
    option<&SerialSettings::data_bits>("data_bits", "", 5, 8, "Data bits of a byte."),
    option<&SerialSettings::parity>("parity", "Parity bit.", parities),
    option<&SerialSettings::stop_bits>("stop_bits", "", 1, 2, "Stop bits of a byte."),
};

struct PortDeleter {
    void operator()(sp_port* port) const {
        sp_close(port);
        sp_free_port(port);
    }
};
using Port = std::unique_ptr<sp_port, PortDeleter>;

/// Start bit, data, parity and stop bits, one after the other.
Duration byte_time(const SerialSettings& settings) {
    const int bits = 1 + settings.data_bits + (settings.parity == "none" ? 0 : 1) + settings.stop_bits;
    return duration_from_s(static_cast<double>(bits) / settings.baud_bd);
}

sp_parity parity_of(const SerialSettings& settings) {
    return static_cast<sp_parity>(std::find(parities.begin(), parities.end(), settings.parity) - parities.begin());
}

bool configure(sp_port* port, const SerialSettings& settings) {
    return sp_set_baudrate(port, settings.baud_bd) == SP_OK && sp_set_bits(port, settings.data_bits) == SP_OK &&
           sp_set_parity(port, parity_of(settings)) == SP_OK && sp_set_stopbits(port, settings.stop_bits) == SP_OK &&
           sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK;
}

/// An FTDI adapter holds bytes back for 16 ms otherwise. Drivers that know no such thing refuse; that is no error.
void ask_for_low_latency(int fd) {
    serial_struct serial{};
    if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return;
    serial.flags |= ASYNC_LOW_LATENCY;
    ::ioctl(fd, TIOCSSERIAL, &serial);
}

/// Call it right after the failure: errno says more than libserialport does.
std::string open_sentence(const std::string& path) {
    switch (errno) {
    case EACCES:
    case EPERM:
        return "no permission for '" + path + "': add this user to the group that `ls -lL` shows (dialout)";
    case EBUSY:
    case EAGAIN:
        return in_use_sentence(path);
    default:
        return "'" + path + "' cannot be opened: " + std::strerror(errno);
    }
}

class Serial : public StreamTransport {
  public:
    explicit Serial(const SerialSettings& settings) : StreamTransport{settings.path}, settings_{settings} {
        byte_time_ = byte_time(settings);
    }
    ~Serial() override { Serial::close(); }

    bool open() override {
        close();
        std::error_code failed;
        const std::string real = std::filesystem::canonical(device_, failed);
        if (failed)
            return refuse("'" + device_ + "' is not there: is it plugged in? `ls /dev/serial/by-id` shows what is");
        if (real.starts_with("/dev/pts/")) return refuse("'" + device_ + "' is a pseudo-terminal: use transport: pty");
        return open_port(real);
    }

    void close() override {
        fd_.release(); // it is the port's
        port_.reset();
    }

  private:
    bool open_port(const std::string& real) {
        sp_port* port = nullptr;
        if (sp_get_port_by_name(real.c_str(), &port) != SP_OK) {
            return refuse("'" + device_ +
                          "' is no serial port of this machine: for a pseudo-terminal use transport: pty, "
                          "for a named pipe transport: fifo");
        }
        errno = 0;
        const bool opened = sp_open(port, SP_MODE_READ_WRITE) == SP_OK;
        if (!opened) {
            sp_free_port(port);
            return refuse(open_sentence(device_));
        }
        port_.reset(port);
        return set_up();
    }

    bool set_up() {
        int fd = -1;
        if (sp_get_port_handle(port_.get(), &fd) != SP_OK || !lock_device(fd)) {
            close();
            return refuse(in_use_sentence(device_));
        }
        if (!configure(port_.get(), settings_)) {
            close();
            return refuse("'" + device_ + "' does not take " + std::to_string(settings_.baud_bd) +
                          " Bd with these bits, parity and stop bits");
        }
        ask_for_low_latency(fd);
        fd_.reset(fd);
        return true;
    }

    const SerialSettings settings_;
    Port port_;
};

} // namespace

TransportRow serial_row() {
    return {"serial",
            "Serial port or USB serial adapter.",
            Wire::bytes,
            false,
            option_table<SerialSettings>(serial_options),
            [](const void* settings) -> std::unique_ptr<Transport> {
                return std::make_unique<Serial>(*static_cast<const SerialSettings*>(settings));
            },
            "path"};
}

} // namespace locus
