// locus import: RINEX files, UBX and NMEA logs and poses of a SLAM into a recording that can be replayed.
#include "tools/import/import.h"
#include "tools/client/command.h"
#include "tools/import/report.h"
#include "tools/show/terminal.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

namespace locus {
namespace {

using tools::complain;

struct ImportOptions {
    importing::Request request;
    std::uint64_t tag = 0;
    std::optional<std::uint64_t> camera{};
    bool json = false;
};

int run_import(ImportOptions& options) {
    options.request.tag = address(options.tag);
    if (options.camera) options.request.poses.camera = address(*options.camera);
    try {
        const auto reports = importing::import_files(options.request);
        if (options.json)
            fmt::print("{}\n", report_json(reports, options.request.output));
        else
            tools::print_lines(report_lines(reports));
        if (importing::measurements(reports) > 0) return exit_yes;
        complain("no measurement was found");
        return exit_no;
    } catch (const std::exception& error) {
        complain(error.what());
        return exit_usage;
    }
}

} // namespace

void add_import(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<ImportOptions>();
    CLI::App& app =
        *root.add_subcommand("import", "Turns RINEX files, UBX and NMEA logs, and a SLAM's poses into a recording");
    app.add_option("FILE", options->request.files,
                   "Observations and navigation of RINEX 2 (navigation) and 3, logs of UBX or NMEA, TUM poses, "
                   "recordings of measurements; told by content")
        ->required();
    app.add_option("-o,--output", options->request.output, "Recording to write (.jsonl)")
        ->required()
        ->type_name("FILE");
    app.add_option("--tag", options->tag, "Address of the target that carried the receiver or the camera; left out: 0")
        ->type_name("ADDRESS");
    app.add_option("--camera", options->camera, "Address of the camera of TUM poses; left out: that of the tag")
        ->type_name("ADDRESS");
    app.add_option("--poses-shift", options->request.poses_shift_s,
                   "Added to the stamps of TUM poses: from their clock to that of the other files; left out: 0")
        ->check(CLI::Range(-4e9, 4e9))
        ->type_name("S");
    app.add_option("--poses-gap", options->request.poses.gap_s,
                   "TUM poses further apart than this are of two segments; left out: 5")
        ->check(CLI::Range(0.1, 3600.0))
        ->type_name("S");
    app.add_flag("--force", options->request.overwrite, "Overwrite the recording when it is there already");
    app.add_flag("--json", options->json, "Print what was found as one JSON object");
    app.footer(
        "Example:\n  locus import drive.obs brdc1180.19n -o drive.jsonl --tag 7\n"
        "  locus replay drive.jsonl --config car.yaml --poses drive.tum\n"
        "  locus import ranges.jsonl key_frames.txt -o walk.jsonl --tag 7\n"
        "Times are GPS time, in seconds since 1980-01-06, but those of poses and recordings, which stay as they\n"
        "are. What stands in a file is told by its first lines, not\n"
        "by its name. Navigation files become the words that the satellites sent.\n"
        "Exit codes: 0 there are measurements, 1 there is none, 2 a file cannot be used.");
    app.callback([options, &exit_code] { exit_code = run_import(*options); });
}

} // namespace locus
