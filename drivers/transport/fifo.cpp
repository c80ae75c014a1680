// A named pipe, for the simplest of simulators: `cat recording > pipe`. Held open for writing as well, so that writers
// may come and go without an end of file.
#include "drivers/transport/rows.h"
#include "drivers/transport/stream.h"

#include <sys/stat.h>

#include <array>

namespace locus {
namespace {

struct FifoSettings {
    std::string path;
};

constexpr std::array fifo_options{
    required_option<&FifoSettings::path>("path", "Named pipe, as `mkfifo` makes it."),
};

bool is_fifo(int fd) {
    struct stat status{};
    return ::fstat(fd, &status) == 0 && S_ISFIFO(status.st_mode);
}

class Fifo : public StreamTransport {
  public:
    explicit Fifo(const FifoSettings& settings) : StreamTransport{settings.path} {}

    bool open() override {
        std::string error;
        fd_ = open_device(device_, "named pipe", error);
        if (!fd_) return refuse(error);
        if (is_fifo(fd_.get())) return true;
        close();
        return refuse("'" + device_ +
                      "' is not a named pipe: make one with mkfifo; for a recording use transport: recording");
    }
};

} // namespace

TransportRow fifo_row() {
    return {"fifo",
            "Named pipe; writers may come and go.",
            Wire::bytes,
            false,
            option_table<FifoSettings>(fifo_options),
            [](const void* settings) -> std::unique_ptr<Transport> {
                return std::make_unique<Fifo>(*static_cast<const FifoSettings*>(settings));
            },
            "path"};
}

} // namespace locus
