// A *.log recording as it is written: the inputs' threads put their lines into it, one after the other.
#pragma once

#include "drivers/recording/log_line.h"
#include "drivers/transport/transport.h"

#include <cstdio>
#include <memory>
#include <mutex>
#include <string>

namespace locus {

class LogFile {
  public:
    /// A file that is there already is kept, unless `overwrite`. On failure `error` says what to do.
    bool open(const std::string& path, bool overwrite, std::string& error);
    /// From any thread. A whole line or nothing goes in between two flushes, never half of two.
    void write_line(const std::string& line);
    /// False when something could not be written since it was opened: the disk is full.
    bool flush();

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::mutex mutex_;
    std::unique_ptr<std::FILE, Closer> file_;
};

/// Listens to one input. `file` outlives it.
class LogTap : public PacketSink {
  public:
    LogTap(std::string input, LogFile& file) : input_{std::move(input)}, file_{file} {}
    void packet(const Packet& packet) override { file_.write_line(to_log_line(input_, packet)); }

  private:
    const std::string input_;
    LogFile& file_;
};

} // namespace locus
