// One entry of SOURCES. The daemon says what became of the last measurement; whether that was a moment or an hour ago
// is for the reader to see.
#pragma once

#include "tools/client/fields.h"

namespace locus::tools {

/// Silent for longer, a source is no longer shown as used.
inline constexpr double silent_after_s = 2;

inline bool in_use(const nlohmann::json& source) {
    return flag(source, "used") && number(source, "last_used_age_s").value_or(0) < silent_after_s;
}

} // namespace locus::tools
