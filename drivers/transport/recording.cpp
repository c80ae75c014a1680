// A *.log recording in place of a device: the lines of one input, at the pace they came, with their stamps moved to
// now. The first line of the file, of whatever input, is the zero of time, so inputs that play the same file stay
// together as well as their threads open it together (milliseconds).
#include "drivers/clock.h"
#include "drivers/recording/log_line.h"
#include "drivers/transport/rows.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <thread>

namespace locus {
namespace {

constexpr Duration pause_between_loops = std::chrono::milliseconds{100};

struct RecordingSettings {
    std::string path;
    std::string input;
    double speed = 1;
    bool loop = false;
};

constexpr std::array recording_options{
    required_option<&RecordingSettings::path>("path", "File that `locus record` or candump -l wrote."),
    option<&RecordingSettings::input>("input", "Plays only the lines of this input or interface; empty: every line."),
    option<&RecordingSettings::speed>(
        "speed", "", 0, 1000,
        "1: as it was recorded; 2: twice as fast; 0: as fast as possible, stamps spaced as "
        "recorded."),
    option<&RecordingSettings::loop>("loop", "Whether it starts again at its end."),
};

class Recording : public Transport {
  public:
    explicit Recording(RecordingSettings settings) : settings_{std::move(settings)} {}

    bool open() override {
        start_ = receive_stamp(monotonic_now());
        if (rewind()) return true;
        const std::string wanted = settings_.input.empty() ? "" : " of input '" + settings_.input + "'";
        if (error_.empty()) error_ = "'" + settings_.path + "' has no line" + wanted + " that can be played";
        return false;
    }
    void close() override { file_.close(); }

    ReadStatus read(PacketSink& sink, Duration timeout) override {
        if (!next_ && !start_again()) return ReadStatus::ended;
        const Timestamp due = due_time();
        if (settings_.speed > 0 && !wait_for(due, timeout)) return ReadStatus::ok;
        Packet packet = next_->packet(); // NOLINT(bugprone-unchecked-optional-access): start_again() finds one
        packet.time = last_due_ = due;
        sink.packet(packet);
        advance();
        return ReadStatus::ok;
    }

    std::string_view last_error() const override { return error_; }
    std::string_view trouble() const override { return trouble_; }

  private:
    /// At the first line of this input. False when there is none.
    bool rewind() {
        file_ = std::ifstream{settings_.path};
        error_ = file_ ? "" : "'" + settings_.path + "' cannot be read: no such file, or no permission";
        line_ = 0;
        first_.reset();
        return file_ && advance();
    }

    bool start_again() {
        start_ = receive_stamp(std::max(monotonic_now(), last_due_) + pause_between_loops);
        return settings_.loop && rewind();
    }

    bool advance() {
        next_.reset();
        for (std::string text; !next_ && std::getline(file_, text);) consider(text);
        return next_.has_value();
    }

    void consider(const std::string& text) {
        std::string error;
        ++line_;
        auto record = from_log_line(text, error);
        if (!error.empty()) {
            trouble_ = "line " + std::to_string(line_) + " of '" + settings_.path + "' was left out: " + error;
        }
        if (!record) return;
        if (!first_) first_ = record->time;
        if (settings_.input.empty() || record->input == settings_.input) next_ = std::move(record);
    }

    Timestamp due_time() const {
        Duration offset = next_->time - *first_; // NOLINT(bugprone-unchecked-optional-access): read() asks first
        const bool scaled = settings_.speed != 0 && settings_.speed != 1;
        if (scaled) offset = duration_from_s(std::clamp(to_s(offset) / settings_.speed, -1e9, 1e9));
        return start_ + offset;
    }

    /// False when it is not due within the timeout.
    static bool wait_for(Timestamp due, Duration timeout) {
        const Duration wait = due - monotonic_now();
        if (wait > Duration::zero()) std::this_thread::sleep_for(std::min(wait, timeout));
        return wait <= timeout;
    }

    const RecordingSettings settings_;
    std::ifstream file_;
    std::size_t line_ = 0;
    std::optional<Timestamp> first_; ///< in the file's clock
    std::optional<LogRecord> next_;
    Timestamp start_{}; ///< when first_ is played
    Timestamp last_due_{};
    std::string error_;
    std::string trouble_;
};

} // namespace

TransportRow recording_row() {
    return {"recording",
            "A recorded *.log file, played at its own pace.",
            std::nullopt,
            false,
            option_table<RecordingSettings>(recording_options),
            [](const void* settings) -> std::unique_ptr<Transport> {
                return std::make_unique<Recording>(*static_cast<const RecordingSettings*>(settings));
            }};
}

} // namespace locus
