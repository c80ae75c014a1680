// Where the targets really were, one TUM file each: "t x y z qx qy qz qw", what `locus evaluate` reads.
#pragma once

#include "fusion/time.h"
#include "tools/simulate/world.h"

#include <string>

namespace locus::simulate {

/// The file of one target: `path` itself when it is the only one, else with "-name" before the extension.
std::string truth_path(const std::string& path, const std::string& target_name, bool only_one);

/// One line with its end; orientation is the heading of the motion.
std::string tum_line(Timestamp time, const TruePose& pose);

} // namespace locus::simulate
