#include "drivers/camera/v4l2_device.h"

#include "drivers/transport/unique_fd.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <cerrno>

namespace locus::camera {
namespace {

class KernelDevice : public V4l2Device {
  public:
    int open(const std::string& path) override {
        fd_.reset(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
        return fd_ ? 0 : errno;
    }

    void close() override { fd_.reset(); }

    int control(unsigned long request, void* argument) override {
        int result = 0;
        do result = ::ioctl(fd_.get(), request, argument);
        while (result != 0 && errno == EINTR);
        return result == 0 ? 0 : errno;
    }

    /// Writable, because drivers refuse to share memory that is not.
    std::span<const std::uint8_t> map(std::size_t size, std::int64_t offset) override {
        void* start = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd_.get(), offset);
        if (start == MAP_FAILED) return {};
        return {static_cast<const std::uint8_t*>(start), size};
    }

    void unmap(std::span<const std::uint8_t> buffer) override {
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): munmap takes the address, it writes nothing
        ::munmap(const_cast<std::uint8_t*>(buffer.data()), buffer.size());
    }

    Ready wait(Duration timeout) override {
        pollfd waiting{fd_.get(), POLLIN | POLLPRI, 0};
        const auto timeout_ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
        const int ready = ::poll(&waiting, 1, static_cast<int>(timeout_ms));
        if (ready <= 0) return ready == 0 || errno == EINTR ? Ready::nothing : Ready::gone;
        if (waiting.revents & POLLPRI) return Ready::event;
        return waiting.revents & POLLIN ? Ready::frame : Ready::gone;
    }

  private:
    UniqueFd fd_;
};

} // namespace

std::unique_ptr<V4l2Device> make_v4l2_device() { return std::make_unique<KernelDevice>(); }

} // namespace locus::camera
