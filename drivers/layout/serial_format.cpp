#include "drivers/layout/serial_format.h"

#include "drivers/wire/checksum.h"

#include <algorithm>
#include <charconv>

namespace locus::layout {
namespace {

std::uint64_t numbers(wire::Bytes bytes, std::size_t at, std::size_t count, std::string_view order) {
    return order == "big" ? wire::big_bytes(bytes, at, count) : wire::little_bytes(bytes, at, count);
}

void put(std::vector<std::uint8_t>& frame, std::size_t at, std::uint64_t value, std::size_t count,
         std::string_view order) {
    for (std::size_t i = 0; i < count; ++i)
        frame[at + (order == "big" ? count - 1 - i : i)] = static_cast<std::uint8_t>(value >> (8 * i));
}

std::size_t checksum_size(std::string_view name) {
    if (name == "none") return 0;
    return name == "sum8" || name == "sum8_complement" || name == "xor8" ? 1 : 2;
}

} // namespace

SerialFormat::SerialFormat(const SerialLayoutSettings& settings)
    : settings_{settings}, sync_{bytes_of_hex(settings.sync).value_or(std::vector<std::uint8_t>{0})},
      tail_{bytes_of_hex(settings.tail).value_or(std::vector<std::uint8_t>{})},
      checksum_bytes_{checksum_size(settings.checksum)},
      shortest_{std::max(sync_.size() + tail_.size(),
                         sync_.size() + checksum_bytes_ + static_cast<std::size_t>(settings.checksum_trailer_bytes))} {
    for (const SerialField& field : settings.fields)
        if (!field.in_element)
            shortest_ = std::max<std::size_t>(shortest_, static_cast<std::size_t>(field.at_byte + field.bytes));
    if (settings.frame_bytes == 0)
        shortest_ =
            std::max<std::size_t>(shortest_, static_cast<std::size_t>(settings.length_at_byte + settings.length_bytes));
}

Look SerialFormat::look(wire::Bytes bytes) const {
    const std::size_t known = std::min(bytes.size(), sync_.size());
    if (!std::equal(sync_.begin(), sync_.begin() + static_cast<std::ptrdiff_t>(known), bytes.begin()))
        return Look::none(Refusal::garbage);
    if (bytes.size() < shortest_) return Look::need(shortest_);
    auto length = static_cast<std::size_t>(settings_.frame_bytes);
    if (length == 0) {
        const auto at = static_cast<std::size_t>(settings_.length_at_byte);
        const auto count = static_cast<std::size_t>(settings_.length_bytes);
        const auto said = numbers(bytes, at, count, settings_.length_byte_order);
        length = static_cast<std::size_t>(static_cast<std::int64_t>(said) + settings_.length_adds);
    }
    if (length > max_length) return Look::none(Refusal::too_long);
    if (length < shortest_) return Look::none(Refusal::malformed);
    if (bytes.size() < length) return Look::need(length);
    return is_intact(bytes.first(length)) ? Look::frame(length) : Look::none(Refusal::bad_checksum);
}

bool SerialFormat::is_intact(wire::Bytes frame) const {
    if (!std::equal(tail_.begin(), tail_.end(), frame.end() - static_cast<std::ptrdiff_t>(tail_.size()))) return false;
    return checksum_bytes_ == 0 ||
           checksum(frame) == numbers(frame, checksum_at(frame.size()), checksum_bytes_, settings_.checksum_byte_order);
}

std::uint64_t SerialFormat::checksum(wire::Bytes frame) const {
    const std::size_t end = checksum_at(frame.size());
    const auto covered =
        frame.first(end).subspan(std::min<std::size_t>(end, static_cast<std::size_t>(settings_.checksum_from_byte)));
    const std::string& name = settings_.checksum;
    if (name == "sum8") return wire::sum8(covered);
    if (name == "sum8_complement") return static_cast<std::uint8_t>(-wire::sum8(covered));
    if (name == "xor8") return wire::xor8(covered);
    if (name == "fletcher8") return wire::fletcher8(covered);
    if (name == "crc16_xmodem") return wire::crc16_xmodem(covered);
    if (name == "crc16_kermit") return wire::crc16_kermit(covered);
    return wire::crc16_modbus(covered);
}

void SerialFormat::seal(std::vector<std::uint8_t>& frame) const {
    std::copy(sync_.begin(), sync_.end(), frame.begin());
    std::copy(tail_.begin(), tail_.end(), frame.end() - static_cast<std::ptrdiff_t>(tail_.size()));
    if (settings_.frame_bytes == 0)
        put(frame, static_cast<std::size_t>(settings_.length_at_byte),
            static_cast<std::uint64_t>(static_cast<std::int64_t>(frame.size()) - settings_.length_adds),
            static_cast<std::size_t>(settings_.length_bytes), settings_.length_byte_order);
    if (checksum_bytes_ > 0)
        put(frame, checksum_at(frame.size()), checksum(frame), checksum_bytes_, settings_.checksum_byte_order);
}

std::optional<std::vector<std::uint8_t>> bytes_of_hex(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    while (!text.empty()) {
        if (text[0] == ' ') {
            text.remove_prefix(1);
            continue;
        }
        std::uint8_t byte = 0;
        const auto digits = text.substr(0, 2);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
        if (error != std::errc{} || end != digits.data() + 2 || bytes.size() == 16) return std::nullopt;
        bytes.push_back(byte);
        text.remove_prefix(2);
    }
    return bytes;
}

} // namespace locus::layout
