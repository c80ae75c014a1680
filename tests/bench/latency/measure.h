// What the figures are made of.
#pragma once

#include "drivers/clock.h"
#include "tests/support/daemon_process.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace locus::bench {

inline double to_us(Duration duration) { return std::chrono::duration<double, std::micro>(duration).count(); }

/// Of a series in microseconds.
struct Figures {
    double p50 = 0, p99 = 0, max = 0;
    std::size_t count = 0;

    static Figures of(std::vector<double> values) {
        if (values.empty()) return {};
        std::ranges::sort(values);
        const auto at = [&](double share) {
            return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
        };
        return {at(0.5), at(0.99), values.back(), values.size()};
    }
};

/// Processor time of each thread of a process by its name, ns (/proc/PID/task/*/schedstat).
inline std::map<std::string, double> cpu_ns(pid_t pid) {
    std::map<std::string, double> by_name;
    for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
        std::string name;
        double ns = 0;
        std::getline(std::ifstream{task.path() / "comm"}, name);
        std::ifstream{task.path() / "schedstat"} >> ns;
        by_name[name] += ns;
    }
    return by_name;
}

} // namespace locus::bench
