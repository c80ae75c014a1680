#include "tools/simulate/truth.h"

#include "drivers/recording/stamp.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace locus::simulate {

std::string truth_path(const std::string& path, const std::string& target_name, bool only_one) {
    if (only_one) return path;
    std::filesystem::path file(path);
    file.replace_filename(file.stem().string() + "-" + target_name + file.extension().string());
    return file.string();
}

std::string tum_line(Timestamp time, const TruePose& pose) {
    std::string line;
    append_seconds(line, time);
    const auto& p = pose.position_site_m;
    return line + fmt::format(" {:.6f} {:.6f} {:.6f} 0 0 {:.9f} {:.9f}\n", p.x(), p.y(), p.z(),
                              std::sin(pose.heading_rad / 2), std::cos(pose.heading_rad / 2));
}

} // namespace locus::simulate
