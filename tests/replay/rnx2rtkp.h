// Debian's rtklib as a second opinion on positions: what its rnx2rtkp makes of RINEX files, and where on the way it saw
// the satellites.
#pragma once

#include "fusion/gnss/calendar.h"
#include "tests/support/temporary_folder.h"

#include <Eigen/Core>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace locus::test {

inline bool rnx2rtkp_installed() { return std::system("command -v rnx2rtkp >/dev/null 2>&1") == 0; }

struct RtklibFix {
    Eigen::Vector3d position_ecef_m;
    int satellites = 0;
};

/// Where it saw a satellite, and the satellite's clock.
struct RtklibSatellite {
    int number = 0; ///< of rtklib: GPS 1 to 32, BeiDou from 106 on
    gnss::GpsTime time;
    Eigen::Vector3d position_ecef_m;
    double clock_s = 0;
};

struct Rtklib {
    std::map<long, RtklibFix> fixes; ///< by second of the week; it prints the time without the receiver's clock error
    std::vector<RtklibSatellite> satellites;
};

namespace rtklib {

inline void read_fixes(const std::string& path, Rtklib& read) {
    std::ifstream file(path);
    double week = 0, second = 0;
    int quality = 0;
    for (std::string line; std::getline(file, line);) {
        RtklibFix fix;
        auto& at = fix.position_ecef_m;
        if (std::sscanf(line.c_str(), "%lf %lf %lf %lf %lf %d %d", &week, &second, &at[0], &at[1], &at[2], &quality,
                        &fix.satellites) == 7)
            read.fixes[std::lround(second)] = fix;
    }
}

/// "4 2025/08/28 17:30:39.679881 sat=10 rs= -7900001.481 -12754845.318  22189208.890 dts= -516181.054 ...", in ns.
inline void read_satellites(const std::string& path, Rtklib& read) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        gnss::CivilTime date;
        RtklibSatellite one;
        auto& at = one.position_ecef_m;
        double clock_ns = 0;
        if (line.find(" rs=") == std::string::npos ||
            std::sscanf(line.c_str(), "%*d %d/%d/%d %d:%d:%lf sat=%d rs=%lf %lf %lf dts=%lf", &date.year, &date.month,
                        &date.day, &date.hour, &date.minute, &date.second, &one.number, &at[0], &at[1], &at[2],
                        &clock_ns) != 11)
            continue;
        one.time = gnss::gps_time(date).value_or(gnss::GpsTime{});
        one.clock_s = clock_ns * 1e-9;
        if (at.norm() > 0) read.satellites.push_back(one);
    }
}

} // namespace rtklib

/// Single points with broadcast ephemerides, Klobuchar and Saastamoinen. `systems`: 1 GPS, 32 BeiDou, 33 both.
inline Rtklib rnx2rtkp(const std::vector<std::string>& files, int systems, int mask_deg, bool trace = false) {
    const TemporaryFolder folder;
    std::ofstream(folder / "conf") << "pos1-posmode=single\npos1-elmask=" << mask_deg
                                   << "\npos1-ionoopt=brdc\npos1-tropopt=saas\npos1-sateph=brdc\npos1-posopt5=off\n"
                                   << "pos1-navsys=" << systems
                                   << "\nout-solformat=xyz\nout-timesys=gpst\nout-timeform=tow\n";
    std::string command = "rnx2rtkp -k " + folder / "conf" + " -o " + folder / "out.pos";
    if (trace) command += " -x 4";
    for (const auto& file : files) command += " '" + file + "'";
    Rtklib read;
    if (std::system((command + " >/dev/null 2>&1").c_str()) != 0) return read;
    rtklib::read_fixes(folder / "out.pos", read);
    if (trace) rtklib::read_satellites(folder / "out.pos.trace", read);
    return read;
}

} // namespace locus::test
