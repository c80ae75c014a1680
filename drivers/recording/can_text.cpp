#include "drivers/recording/can_text.h"

#include "drivers/recording/hex.h"

#include <linux/can.h>

namespace locus {
namespace {

constexpr std::uint32_t widest_id = CAN_ERR_FLAG | CAN_EFF_MASK;

void append_id(std::string& text, std::uint32_t id) {
    const bool long_form = id & (CAN_EFF_FLAG | CAN_ERR_FLAG);
    const std::uint32_t shown = id & (long_form ? widest_id : CAN_SFF_MASK);
    for (int shift = long_form ? 28 : 8; shift >= 0; shift -= 4) text += hex_digits[(shown >> shift) & 0xF];
}

bool parse_fd(std::string_view text, LogRecord& record, std::string& error) {
    std::uint32_t flags = 0;
    if (!parse_hex_number(text.substr(0, 1), flags)) {
        error = "there are no flags after ##";
        return false;
    }
    record.can_fd = true;
    record.can_fd_flags = static_cast<std::uint8_t>(flags);
    return parse_hex_bytes(text.substr(1), CANFD_MAX_DLEN, record.data, error);
}

bool parse_remote(std::string_view length, LogRecord& record, std::string& error) {
    std::uint32_t bytes = 0;
    record.can_id |= CAN_RTR_FLAG;
    if (length.empty()) return true;
    if (length.size() != 1 || !parse_hex_number(length, bytes) || bytes > CAN_MAX_DLEN) {
        error = "the length after #R is not 0 to 8";
    }
    return error.empty();
}

/// Classic data may end in "_<dlc>" when the wire's length code was above 8; there are 8 bytes all the same.
bool parse_classic(std::string_view text, LogRecord& record, std::string& error) {
    const std::size_t mark = text.find('_');
    std::uint32_t dlc = 0xF;
    const bool code =
        mark == std::string_view::npos || (mark == 2 * CAN_MAX_DLEN && text.size() == mark + 2 &&
                                           parse_hex_number(text.substr(mark + 1), dlc) && dlc > CAN_MAX_DLEN);
    if (!code) error = "a length code after _ goes with 8 bytes and is 9 to F";
    return code && parse_hex_bytes(text.substr(0, mark), CAN_MAX_DLEN, record.data, error);
}

} // namespace

bool parse_can_id(std::string_view hex, std::uint32_t& id) {
    if ((hex.size() != 3 && hex.size() != 8) || !parse_hex_number(hex, id)) return false;
    if (hex.size() == 3) return id <= CAN_SFF_MASK;
    if (id > widest_id) return false;
    if (!(id & CAN_ERR_FLAG)) id |= CAN_EFF_FLAG;
    return true;
}

void append_can_text(std::string& text, const Packet& packet) {
    append_id(text, packet.can_id);
    text += '#';
    if (packet.can_fd) {
        text += '#';
        text += hex_digits[packet.can_fd_flags & 0xF];
    } else if (packet.can_id & CAN_RTR_FLAG) {
        text += 'R';
        return;
    }
    append_hex(text, packet.data);
}

bool parse_can_text(std::string_view text, LogRecord& record, std::string& error) {
    const std::size_t hash = text.find('#');
    record.wire = Wire::can;
    if (hash == std::string_view::npos || !parse_can_id(text.substr(0, hash), record.can_id)) {
        error = "the CAN id before # has neither 3 hex digits up to 7FF nor 8";
        return false;
    }
    const std::string_view rest = text.substr(hash + 1);
    if (rest.starts_with('#')) return parse_fd(rest.substr(1), record, error);
    if (rest.starts_with('R')) return parse_remote(rest.substr(1), record, error);
    return parse_classic(rest, record, error);
}

} // namespace locus
