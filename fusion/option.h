// The option table: one row per setting. The loader, `locus check`, `locus config --print` and the reference page
// are all made from it. A module keeps a plain struct with its defaults and one table beside it:
//
//   struct GateSettings { double false_alarm = 1e-3; };
//   inline constexpr std::array gate_options{
//       option<&GateSettings::false_alarm>("false_alarm", "", 1e-9, 0.1, "Chance that a good range is refused.")};
#pragma once

#include "fusion/measurement.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace locus {

/// A double or a Vec3 component that is NaN is "not set" (only possible as a default, never typed in).
using OptionValue = std::variant<bool, std::int64_t, double, std::string, Address, Vec3>;

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

struct OptionRow {
    std::string_view name;
    std::string_view unit;
    double minimum;
    double maximum;
    std::string_view about;
    std::span<const std::string_view> choices; ///< for strings; empty: any text
    bool required;
    OptionValue (*get)(const void* settings);
    /// `value` holds the alternative that get() returns.
    void (*set)(void* settings, const OptionValue& value);
};

namespace detail {
template <class T>
struct MemberOf;
template <class S, class T>
struct MemberOf<T S::*> {
    using Struct = S;
    using Type = T;
};
template <class T>
struct StoredAs {
    using Type = T; // bool, std::string, Address, Vec3
};
template <std::integral T>
struct StoredAs<T> {
    using Type = std::int64_t;
};
template <>
struct StoredAs<bool> {
    using Type = bool;
};
template <std::floating_point T>
struct StoredAs<T> {
    using Type = double;
};

/// The tighter of a row's limits and what its member can hold: no row can make a cast that wraps.
template <class T>
constexpr std::pair<double, double> limits_within(double minimum, double maximum) {
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
        using Limits = std::numeric_limits<std::conditional_t<(sizeof(T) < 8), T, std::int32_t>>;
        return {std::max(minimum, double{Limits::min()}), std::min(maximum, double{Limits::max()})};
    }
    return {minimum, maximum};
}
} // namespace detail

/// A row bound to a struct member of type bool, an integer, double, std::string, Address or Vec3 (limits: of each
/// component). `Settings` is what the table is for, where the member stands in a base of it.
template <auto Member, class Settings = typename detail::MemberOf<decltype(Member)>::Struct>
constexpr OptionRow option(std::string_view name, std::string_view unit, double minimum, double maximum,
                           std::string_view about, std::span<const std::string_view> choices = {},
                           bool required = false) {
    using Type = typename detail::MemberOf<decltype(Member)>::Type;
    using Stored = typename detail::StoredAs<Type>::Type;
    constexpr auto within = detail::limits_within<Type>;
    return {name,
            unit,
            within(minimum, maximum).first,
            within(minimum, maximum).second,
            about,
            choices,
            required,
            [](const void* settings) -> OptionValue {
                return static_cast<Stored>(static_cast<const Settings*>(settings)->*Member);
            },
            [](void* settings, const OptionValue& value) {
                static_cast<Settings*>(settings)->*Member = static_cast<Type>(std::get<Stored>(value));
            }};
}

/// A row without limits, for texts and booleans.
template <auto Member, class Settings = typename detail::MemberOf<decltype(Member)>::Struct>
constexpr OptionRow option(std::string_view name, std::string_view about,
                           std::span<const std::string_view> choices = {}) {
    return option<Member, Settings>(name, "", -no_limit, no_limit, about, choices);
}

template <auto Member>
constexpr OptionRow required_option(std::string_view name, std::string_view about) {
    return option<Member>(name, "", -no_limit, no_limit, about, {}, true);
}

/// Two tables as one: what a family of devices has in common, then a device's own rows.
template <std::size_t first, std::size_t second>
constexpr std::array<OptionRow, first + second> joined(const std::array<OptionRow, first>& a,
                                                       const std::array<OptionRow, second>& b) {
    std::array<OptionRow, first + second> rows{};
    std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), rows.begin()));
    return rows;
}

using Options = std::span<const OptionRow>;

/// A list of maps beside the rows, for what comes in any number: `signals: [{name: ..., start_bit: 7}, ...]`.
struct OptionList {
    std::string_view name;
    std::string_view about;
    Options rows; ///< of each item
    void* (*append)(void* settings);
    std::size_t (*size)(const void* settings);
    const void* (*item)(const void* settings, std::size_t index);
};

/// A list bound to a struct member that is a std::vector of plain structs, whose rows `rows` are.
template <auto Member>
constexpr OptionList option_list(std::string_view name, std::string_view about, Options rows) {
    using Struct = typename detail::MemberOf<decltype(Member)>::Struct;
    return {name,
            about,
            rows,
            [](void* settings) -> void* { return &(static_cast<Struct*>(settings)->*Member).emplace_back(); },
            [](const void* settings) { return (static_cast<const Struct*>(settings)->*Member).size(); },
            [](const void* settings, std::size_t index) -> const void* {
                return &(static_cast<const Struct*>(settings)->*Member)[index];
            }};
}

using OptionLists = std::span<const OptionList>;

/// A settings struct whose type only its module knows; `make` gives one that holds the defaults.
struct OptionTable {
    Options rows;
    std::shared_ptr<void> (*make)();
    OptionLists lists{};
    /// For what no row alone can tell: a sentence that says what does not fit together, empty when all is well.
    std::string (*check)(const void* settings) = nullptr;
};

template <class Settings>
constexpr OptionTable option_table(Options rows, OptionLists lists = {},
                                   std::string (*check)(const void* settings) = nullptr) {
    return {rows, []() -> std::shared_ptr<void> { return std::make_shared<Settings>(); }, lists, check};
}

} // namespace locus
