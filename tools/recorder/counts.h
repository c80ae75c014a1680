// What a recording session says at its end: per input, what came and what the decoder made of it.
#pragma once

#include "tools/recorder/session.h"

#include <string>

namespace locus::tools {

void print_counts(const RecordSession& session);
void print_counts_json(const RecordSession& session, const std::string& output);

} // namespace locus::tools
