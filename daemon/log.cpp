#include "daemon/log.h"

#include <spdlog/async.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace locus {
namespace {

constexpr std::size_t waiting_lines = 1024;

/// "<4>" before a line is how journald takes its priority from stderr (sd-daemon(3)).
class JournalPriority : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
        constexpr std::array<char, spdlog::level::n_levels> priorities{'7', '7', '6', '4', '3', '2', '6'};
        out.push_back('<');
        out.push_back(priorities[static_cast<std::size_t>(message.level)]);
        out.push_back('>');
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<JournalPriority>(); }
};

/// systemd.exec(5): JOURNAL_STREAM holds device and inode of the stream that goes to the journal.
bool stderr_is_journal() {
    const char* journal = std::getenv("JOURNAL_STREAM");
    struct stat status{};
    if (!journal || ::fstat(STDERR_FILENO, &status) != 0) return false;
    return fmt::format("{}:{}", status.st_dev, status.st_ino) == journal;
}

std::unique_ptr<spdlog::formatter> formatter() {
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<JournalPriority>('J').set_pattern(stderr_is_journal() ? "%J%v" : "%H:%M:%S.%e %^%l%$ %v");
    return formatter;
}

} // namespace

void start_log(const std::string& level) {
    spdlog::init_thread_pool(waiting_lines, 1);
    auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    auto logger = std::make_shared<spdlog::async_logger>("locusd", std::move(sink), spdlog::thread_pool(),
                                                         spdlog::async_overflow_policy::overrun_oldest);
    logger->set_formatter(formatter());
    spdlog::set_default_logger(std::move(logger));
    set_log_level(level);
}

void set_log_level(const std::string& level) { spdlog::set_level(spdlog::level::from_str(level)); }

void end_log() { spdlog::shutdown(); }

} // namespace locus
