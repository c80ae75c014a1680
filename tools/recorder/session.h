// The inputs of a configuration, opened and read into one recording: each in its own thread, as in the daemon.
#pragma once

#include "config/settings.h"
#include "drivers/input.h"
#include "drivers/recording/log_file.h"

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace locus::tools {

class RecordSession {
  public:
    /// Told from the inputs' threads.
    using OnEvent = std::function<void(const std::string& input, const InputEvent& event)>;

    /// Starts the enabled inputs. `file` must stay until the session is gone.
    RecordSession(const std::vector<InputSettings>& settings, LogFile& file, const OnEvent& on_event);

    /// Ends the threads; the counts stay.
    void stop();
    /// Every input was a recording and is at its end.
    bool ended() const;

    /// An input with its tap and thread; the thread goes first.
    struct Part {
        Part(const InputSettings& settings, LogFile& file, const OnEvent& on_event);
        LogTap tap;
        Input input;
        std::jthread thread;
    };
    const std::vector<std::unique_ptr<Part>>& parts() const { return parts_; }

  private:
    std::vector<std::unique_ptr<Part>> parts_;
};

} // namespace locus::tools
