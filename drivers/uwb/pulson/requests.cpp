#include "drivers/uwb/pulson/requests.h"

#include "drivers/uwb/pulson/messages.h"
#include "drivers/uwb/pulson/radio_info.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace locus::uwb::pulson {
namespace {

constexpr std::size_t most_responders = 64;
constexpr Duration silence = std::chrono::seconds{5};

std::string_view trimmed(std::string_view word) {
    word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
    return word.substr(0, word.find_last_not_of(' ') + 1);
}

/// 0 is nobody and the highest number everybody: neither can answer.
bool parse_node(std::string_view word, std::uint32_t& node) {
    const bool hex = word.starts_with("0x");
    if (hex) word.remove_prefix(2);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), node, hex ? 16 : 10);
    return error == std::errc{} && end == word.data() + word.size() && node != 0 &&
           node != std::numeric_limits<std::uint32_t>::max();
}

} // namespace

std::vector<std::uint32_t> parse_responders(std::string_view text, std::string& error) {
    std::vector<std::uint32_t> nodes;
    while (!trimmed(text).empty()) {
        const std::string_view word = text.substr(0, text.find(','));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        nodes.emplace_back();
        if (parse_node(trimmed(word), nodes.back()) && nodes.size() <= most_responders) continue;
        error = nodes.size() > most_responders
                    ? "responders names more than 64 radios"
                    : "responders has '" + std::string{word} + "' where a node id such as 101 is due";
        return {};
    }
    return nodes;
}

std::string check_pulson(const void* settings) {
    std::string error;
    parse_responders(static_cast<const PulsonSettings*>(settings)->responders, error);
    return error;
}

Requests::Requests(std::string_view responders, Duration timeout) : timeout_{timeout} {
    std::string error;
    responders_ = parse_responders(responders, error);
}

std::optional<std::vector<std::uint8_t>> Requests::next(Timestamp now) {
    if (responders_.empty()) return greeting(now);
    if (waiting_ && now - asked_ < timeout_) return std::nullopt;
    RangeRequest request;
    request.message = ++message_;
    request.responder = responders_[turn_];
    turn_ = (turn_ + 1) % responders_.size();
    waiting_ = true;
    asked_ = now;
    return encode(request);
}

std::optional<std::vector<std::uint8_t>> Requests::greeting(Timestamp now) {
    if (last_sign_ && now - *last_sign_ < silence) return std::nullopt;
    last_sign_ = now;
    return encode(StatusRequest{.message = ++message_});
}

void Requests::answered(std::uint16_t message) {
    if (message == message_) waiting_ = false;
}

} // namespace locus::uwb::pulson
