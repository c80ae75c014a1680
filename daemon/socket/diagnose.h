// Why there is no position, in sentences for the engineer with the box in the basement, the first thing to do first.
#pragma once

#include "daemon/socket/picture.h"
#include "daemon/socket/roster.h"

#include <string>
#include <vector>

namespace locus {

/// Empty when at least one target has a pose.
std::vector<std::string> diagnose(const Picture& picture, const Roster& roster);

bool is_working(const Picture& picture);

} // namespace locus
