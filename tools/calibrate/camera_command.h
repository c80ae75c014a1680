// What the command lines of the three ways to calibrate a camera have in common: --out, --json, and how they end.
#pragma once

#include "tools/calibrate/camera_file.h"
#include "tools/client/command.h"
#include "tools/show/terminal.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <exception>
#include <memory>
#include <string>

namespace locus::calibrate {

struct CameraOutput {
    std::string path; ///< empty: the calibration is printed
    bool json = false;
};

inline void put(const CameraReport& report, const CameraOutput& output) {
    if (!output.path.empty()) write_file(output.path, report.yaml);
    if (output.json) return fmt::print("{}\n", report.json.dump());
    tools::print_lines(report.lines);
    if (output.path.empty()) fmt::print("\n{}", report.yaml);
}

template <class Request>
int run_camera(const Request& request, const CameraOutput& output, CameraReport (*work)(const Request&)) {
    try {
        put(work(request), output);
        return exit_yes;
    } catch (const CannotTell& refusal) {
        tools::complain(refusal.what());
        return exit_no;
    } catch (const std::exception& error) {
        tools::complain(error.what());
        return exit_usage;
    }
}

template <class Request>
struct CameraCommand {
    Request request;
    CameraOutput output;
};

template <class Request>
std::shared_ptr<CameraCommand<Request>> add_command(CLI::App& app, int& exit_code,
                                                    CameraReport (*work)(const Request&)) {
    auto command = std::make_shared<CameraCommand<Request>>();
    app.add_option("--out", command->output.path, "Where the calibration is written (YAML); without it it is printed")
        ->type_name("FILE");
    app.add_flag("--json", command->output.json, "Print one JSON object instead of the report");
    app.callback([command, work, &exit_code] { exit_code = run_camera(command->request, command->output, work); });
    return command;
}

} // namespace locus::calibrate
