#include "daemon/socket/command.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace locus {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<std::string_view, Verb>, 7> verbs{{{"?WATCH", Verb::watch},
                                                                  {"?POLL", Verb::poll},
                                                                  {"?SOURCES", Verb::sources},
                                                                  {"?TARGETS", Verb::targets},
                                                                  {"?STATUS", Verb::status},
                                                                  {"?RELOAD", Verb::reload},
                                                                  {"?VIEW", Verb::view}}};

constexpr std::string_view white_space = " \t\r\n\f\v";
constexpr std::size_t max_watched_targets = 1024;

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

/// At most 40 characters, printable, for a message about what was not understood.
std::string quoted(std::string_view text) {
    std::string shown{"\""};
    for (const char c : text.substr(0, 40)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > 40 ? "...\"" : "\"");
}

std::optional<BadCommand> read_flag(const json& options, const char* key, bool& flag) {
    const auto found = options.find(key);
    if (found == options.end()) return {};
    if (!found->is_boolean()) return BadCommand{std::string{"?WATCH: \""} + key + "\" is true or false"};
    flag = found->get<bool>();
    return {};
}

std::optional<BadCommand> read_rate(const json& options, double& rate_hz) {
    const auto found = options.find("rate_hz");
    if (found == options.end()) return {};
    const double value = found->is_number() ? found->get<double>() : -1;
    if (!(value >= 0.001 && value <= 1000)) return BadCommand{"?WATCH: \"rate_hz\" is a number from 0.001 to 1000"};
    rate_hz = value;
    return {};
}

std::optional<BadCommand> read_targets(const json& options, std::vector<std::string>& targets) {
    const auto found = options.find("targets");
    if (found == options.end()) return {};
    const bool names = found->is_array() && !found->empty() && found->size() <= max_watched_targets &&
                       std::ranges::all_of(*found, [](const json& item) { return item.is_string(); });
    if (!names) return BadCommand{"?WATCH: \"targets\" is a list of names"};
    targets = found->get<std::vector<std::string>>();
    return {};
}

ParsedCommand too_long() { return BadCommand{"command of more than 4096 bytes passed over"}; }

ParsedCommand parse_watch(std::string_view text) {
    const json options = json::parse(text, nullptr, false);
    if (!options.is_object())
        return BadCommand{"?WATCH: after '=' comes a JSON object, as in ?WATCH={\"enable\":true};"};
    Watch watch;
    watch.enable = true;
    if (auto bad = read_flag(options, "enable", watch.enable)) return *bad;
    if (auto bad = read_flag(options, "poses", watch.poses)) return *bad;
    if (auto bad = read_flag(options, "smoothed", watch.smoothed)) return *bad;
    if (auto bad = read_flag(options, "readings", watch.readings)) return *bad;
    if (auto bad = read_rate(options, watch.rate_hz)) return *bad;
    if (auto bad = read_targets(options, watch.targets)) return *bad;
    return Command{.verb = Verb::watch, .watch = std::move(watch)};
}

ParsedCommand parse_view(std::string_view text) {
    const json options = json::parse(text, nullptr, false);
    const auto camera = options.is_object() ? options.find("camera") : options.end();
    if (camera == options.end() || !camera->is_string())
        return BadCommand{R"(?VIEW: after '=' comes the name of a camera, as in ?VIEW={"camera":"gate"};)"};
    return Command{.verb = Verb::view, .camera = camera->get<std::string>()};
}

} // namespace

bool Watch::wants(std::string_view target) const {
    return enable && poses && (targets.empty() || std::ranges::find(targets, target) != targets.end());
}

bool Watch::wants_smoothed(std::string_view target) const {
    return enable && smoothed && (targets.empty() || std::ranges::find(targets, target) != targets.end());
}

bool Watch::wants_readings(std::string_view target) const {
    return enable && readings && (targets.empty() || std::ranges::find(targets, target) != targets.end());
}

ParsedCommand parse_command(std::string_view text) {
    text = trimmed(text);
    const auto equals = text.find('=');
    const std::string_view name = trimmed(text.substr(0, equals));
    const auto* found = std::ranges::find(verbs, name, &std::pair<std::string_view, Verb>::first);
    if (found == verbs.end())
        return BadCommand{"unknown command " + quoted(name) +
                          "; there are ?WATCH ?POLL ?SOURCES ?TARGETS ?STATUS ?RELOAD ?VIEW"};
    if (found->second == Verb::view) return parse_view(equals == std::string_view::npos ? "" : text.substr(equals + 1));
    if (equals == std::string_view::npos) return Command{.verb = found->second};
    if (found->second != Verb::watch) return BadCommand{std::string{name} + " takes no '='"};
    return parse_watch(text.substr(equals + 1));
}

std::optional<ParsedCommand> CommandReader::next() {
    for (auto end = buffer_.find(';'); end != std::string::npos; end = buffer_.find(';')) {
        const std::string command = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        if (std::exchange(skipping_, false) || trimmed(command).empty()) continue;
        if (command.size() > max_command) return too_long();
        return parse_command(command);
    }
    return buffer_.size() > max_command ? give_up_on_this_one() : std::nullopt;
}

/// Its bytes go now, its end will be passed over when it comes.
std::optional<ParsedCommand> CommandReader::give_up_on_this_one() {
    buffer_.clear();
    if (std::exchange(skipping_, true)) return {};
    return too_long();
}

} // namespace locus
