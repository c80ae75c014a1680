#include "tools/play/player.h"

#include "drivers/clock.h"
#include "drivers/recording/log_line.h"
#include "tools/client/command.h"
#include "tools/interrupt.h"
#include "tools/simulate/output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace locus::play {
namespace {

using Devices = std::map<std::string, std::unique_ptr<simulate::Output>>;

Devices make_devices(const std::vector<InputSettings>& inputs) {
    Devices devices;
    for (const InputSettings& input : inputs) {
        if (!input.enabled) continue;
        const std::string trouble = simulate::cannot_open(input);
        if (!trouble.empty()) throw std::runtime_error(fmt::format("input '{}': {}", input.name, trouble));
        devices.emplace(input.name, simulate::make_output(input));
    }
    if (devices.empty()) throw std::runtime_error("the configuration has no enabled input to play into");
    return devices;
}

/// What is sent before somebody listens is lost, so the recording begins when everybody does.
void wait_for_readers(const Devices& devices) {
    constexpr Duration pause = std::chrono::milliseconds{20};
    bool told = false;
    for (const auto& [name, device] : devices) {
        while (!tools::interrupted() && !device->has_reader()) {
            if (!std::exchange(told, true)) tools::complain(fmt::format("waiting until somebody reads '{}'", name));
            tools::sleep_until_or_interrupted(monotonic_now() + pause);
        }
    }
}

class Player {
  public:
    Player(const Devices& devices, double speed) : devices_(devices), speed_(speed) {}

    void line(const std::string& text) {
        std::string error;
        ++line_;
        const auto record = from_log_line(text, error);
        if (!error.empty()) note(error);
        if (record) play(*record);
    }

    /// A pseudo-terminal that goes takes with it what its reader has not read yet: so it stays for a moment.
    Result finish() {
        constexpr Duration moment = std::chrono::milliseconds{500};
        result_.took_s = to_s(monotonic_now() - start_);
        tools::sleep_until_or_interrupted(monotonic_now() + moment);
        for (const auto& [name, device] : devices_) result_.lost += device->lost();
        return std::move(result_);
    }

  private:
    void play(const LogRecord& record) {
        const auto device = devices_.find(record.input);
        if (device == devices_.end()) {
            ++result_.of_unknown_inputs[record.input];
            return;
        }
        if (result_.played == 0) first_ = record.time;
        const double offset_s = std::clamp(to_s(record.time - first_) / speed_, 0.0, 1e9);
        tools::sleep_until_or_interrupted(start_ + duration_from_s(offset_s));
        if (tools::interrupted()) return;
        device->second->packet(record.packet());
        ++result_.played;
    }

    void note(const std::string& error) {
        if (++result_.bad_lines <= Result::most_told)
            result_.problems.push_back(fmt::format("line {} left out: {}", line_, error));
    }

    const Devices& devices_;
    double speed_;
    Timestamp start_ = monotonic_now();
    Timestamp first_{}; ///< of the recording, played at start_
    std::uint64_t line_ = 0;
    Result result_;
};

} // namespace

Result play(const std::vector<InputSettings>& inputs, const Request& request) {
    std::ifstream file{request.recording};
    if (!file || file.peek() == std::ifstream::traits_type::eof())
        throw std::runtime_error(fmt::format("'{}' cannot be read, or is empty", request.recording));
    const Devices devices = make_devices(inputs);
    tools::catch_interrupts();
    wait_for_readers(devices);
    Player player(devices, request.speed);
    for (std::string text; !tools::interrupted() && std::getline(file, text);) player.line(text);
    return player.finish();
}

std::string result_json(const Result& result) {
    const nlohmann::json object{{"class", "PLAY"},
                                {"played", result.played},
                                {"lost", result.lost},
                                {"took_s", result.took_s},
                                {"bad_lines", result.bad_lines},
                                {"lines_of_unknown_inputs", result.of_unknown_inputs}};
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace locus::play
