// An option whose value is the name of a row of one of the module tables: transports, decoders, sources, detectors.
#pragma once

#include "fusion/option.h"

#include <string>
#include <string_view>

namespace locus {

namespace detail {
template <class Row>
std::string name_of(const Row* row) {
    return row ? std::string(row->name) : "";
}
} // namespace detail

/// `Member` points to the row, `Find` gives it by name; required.
template <auto Member, auto Find>
constexpr OptionRow row_option(std::string_view name, std::string_view about) {
    using Settings = typename detail::MemberOf<decltype(Member)>::Struct;
    return {name,
            "",
            -no_limit,
            no_limit,
            about,
            {},
            true,
            [](const void* settings) -> OptionValue {
                return detail::name_of(static_cast<const Settings*>(settings)->*Member);
            },
            [](void* settings, const OptionValue& value) {
                static_cast<Settings*>(settings)->*Member = Find(std::get<std::string>(value));
            }};
}

} // namespace locus
