// Lengths of what a radio sends: protocols.md 3.2 and 3.3, and the layouts of the vendor's public headers.
#include "drivers/uwb/pulson/lengths.h"

#include <algorithm>
#include <array>

namespace locus::uwb::pulson {
namespace {

constexpr std::array rules{
    // RCM: confirms, then infos
    LengthRule{0x0101, 8}, LengthRule{0x0102, 32}, LengthRule{0x0103, 8}, LengthRule{0x0104, 8}, LengthRule{0x0105, 8},
    LengthRule{0x0106, 8}, LengthRule{0x0201, 52}, LengthRule{0x0202, 20, 1, 1000, 18, 2},
    LengthRule{0x0203, 32, 4, 350, 28, 4}, LengthRule{0x0204, 24}, LengthRule{0x0205, 14},
    // RangeNet
    LengthRule{0x3101, 8}, LengthRule{0x3102, 32}, LengthRule{0x3103, 8}, LengthRule{0x3104, 8},
    LengthRule{0x3105, 16, 44, 32, 4, 1}, LengthRule{0x3106, 8, 12, 80, 4, 1}, LengthRule{0x3107, 8},
    LengthRule{0x3108, 8, 4, 255, 4, 1}, LengthRule{0x3109, 44}, LengthRule{0x310A, 8},
    LengthRule{0x310B, 8, 1, 1000, 6, 2}, LengthRule{0x310C, 8, 1, 1000, 6, 2}, LengthRule{0x310D, 8},
    LengthRule{0x310E, 24}, LengthRule{0x310F, 36}, LengthRule{0x3110, 8}, LengthRule{0x3111, 12, 24, 32, 4, 1},
    LengthRule{0x3112, 32}, LengthRule{0x3113, 8}, LengthRule{0x3114, 20}, LengthRule{0x3201, 14},
    LengthRule{0x3202, 32}, LengthRule{0x3203, 16, 44, 32, 4, 1}, LengthRule{0x3204, 8, 12, 80, 4, 1},
    // common to all firmwares
    LengthRule{0xF101, 64}, LengthRule{0xF102, 4}, LengthRule{0xF103, 12}, LengthRule{0xF104, 8}, LengthRule{0xF105, 8},
    LengthRule{0xF106, 8}, LengthRule{0xF107, 1408}, LengthRule{0xF108, 8}, LengthRule{0xF109, 8},
    LengthRule{0xF10A, 8}, LengthRule{0xF10B, 8}, LengthRule{0xF10C, 12}, LengthRule{0xF201, 1452},
    LengthRule{0xF202, 4}};

static_assert(std::ranges::is_sorted(rules, {}, &LengthRule::type));
static_assert(std::ranges::all_of(rules, [](const LengthRule& rule) {
    return rule.fixed + std::size_t{rule.item} * rule.most <= longest_message;
}));

} // namespace

std::optional<LengthRule> length_rule(std::uint16_t type) {
    const auto* const rule = std::ranges::lower_bound(rules, type, {}, &LengthRule::type);
    return rule != rules.end() && rule->type == type ? std::optional{*rule} : std::nullopt;
}

} // namespace locus::uwb::pulson
