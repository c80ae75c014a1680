// Files of strangers (TUM trajectories, poses as JSON lines): whatever they hold, a track comes out in order and
// finite, or a sentence with the line.
#include "tools/evaluate/read.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const locus::evaluate::Track& track) {
    for (std::size_t i = 0; i < track.size(); ++i) {
        require(std::isfinite(track[i].time_s) && track[i].position_m.allFinite());
        require(i == 0 || track[i - 1].time_s < track[i].time_s);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto attempt = [&](auto read) {
        std::istringstream stream(text);
        try {
            check(read(stream));
        } catch (const locus::evaluate::FileError& error) {
            require(std::string(error.what()).starts_with("fuzz:"));
        }
    };
    attempt([](std::istream& stream) { return locus::evaluate::read_tum(stream, "fuzz"); });
    attempt([](std::istream& stream) {
        return locus::evaluate::read_tum(stream, "fuzz", locus::evaluate::RepeatedTime::passed_over);
    });
    attempt([](std::istream& stream) { return locus::evaluate::read_pose_lines(stream, "fuzz", ""); });
    attempt([](std::istream& stream) { return locus::evaluate::read_pose_lines(stream, "fuzz", "cart"); });
    return 0;
}
