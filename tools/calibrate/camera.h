// The command line of `locus calibrate camera`.
#pragma once

#include <CLI/CLI.hpp>

namespace locus::calibrate {

void add_camera(CLI::App& calibrate, int& exit_code);

} // namespace locus::calibrate
