// Ctrl-C for commands that run until it: they finish their line and close their files instead of being cut off.
#pragma once

#include "fusion/time.h"

namespace locus::tools {

/// From now on SIGINT and SIGTERM only raise interrupted(), and a pipe without a reader is a failed write, no end.
void catch_interrupts();

bool interrupted();

/// Sleeps until `time` of CLOCK_MONOTONIC, or until interrupted.
void sleep_until_or_interrupted(Timestamp time);

} // namespace locus::tools
