// locus simulate: a scenario played to the daemon through real devices, or into a recording.
#include "drivers/clock.h"
#include "tools/client/command.h"
#include "tools/interrupt.h"
#include "tools/simulate/simulation.h"
#include "tools/simulate/truth.h"

#include <fmt/format.h>

#include <deque>
#include <fstream>
#include <stdexcept>

namespace locus {
namespace {

using namespace locus::simulate;
using tools::complain;

constexpr Timestamp fast_start = timestamp_from_ns(1'000'000'000); // 0 would read as "never"

struct SimulateOptions {
    std::string scenario;
    std::string record;
    std::string truth;
    std::string socket;
    double truth_rate_hz = 100;
    std::optional<double> duration_s;
    std::optional<std::int64_t> seed;
    bool fast = false;
    bool print_config = false;
    bool reference = false;
};

/// A file that is written as the simulation goes, and must be whole at its end.
class ResultFile {
  public:
    explicit ResultFile(const std::string& path) : path_(path), stream_(path, std::ios::binary) {
        if (!stream_) throw std::runtime_error("cannot write '" + path + "'");
    }
    std::ostream& stream() { return stream_; }
    void finish() {
        if (!stream_.flush()) throw std::runtime_error("cannot write all of '" + path_ + "': is the disk full?");
    }

  private:
    std::string path_;
    std::ofstream stream_;
};

/// Everything the simulation writes to; the devices last as long as it.
class Outputs {
  public:
    Outputs(const Scenario& scenario, const SimulateOptions& options, Simulation& simulation) {
        for (std::size_t i = 0; i < scenario.movers.size() && !options.truth.empty(); ++i) {
            const std::string& name = scenario.movers[i].target.name;
            ResultFile& file = add(truth_path(options.truth, name, scenario.movers.size() == 1));
            simulation.add_truth(i, options.truth_rate_hz, file.stream());
        }
        ResultFile* const record = options.record.empty() ? nullptr : &add(options.record);
        for (std::size_t i = 0; i < scenario.sensors.size(); ++i) {
            const InputSettings& input = scenario.sensors[i].input;
            if (record != nullptr) simulation.add_output(i, make_recorder(input, record->stream()));
            if (!options.fast) simulation.add_output(i, make_output(input));
        }
    }
    void finish() {
        for (ResultFile& file : files_) file.finish();
    }

  private:
    std::deque<ResultFile> files_;

    ResultFile& add(const std::string& path) { return files_.emplace_back(path); }
};

void run(Simulation& simulation, Timestamp end, bool fast) {
    while (!tools::interrupted() && simulation.next() < end) {
        if (!fast) tools::sleep_until_or_interrupted(simulation.next());
        if (!tools::interrupted()) simulation.step();
    }
}

int simulate_scenario(const Scenario& scenario, const SimulateOptions& options) {
    const Timestamp start = options.fast ? fast_start : monotonic_now();
    const double duration_s = scenario.simulation.duration_s;
    const Timestamp end = duration_s > 0 ? start + duration_from_s(duration_s) : Timestamp::max();
    Simulation simulation(scenario, start);
    Outputs outputs(scenario, options, simulation);
    tools::catch_interrupts();
    run(simulation, end, options.fast);
    outputs.finish();
    if (simulation.lost() > 0) complain(fmt::format("{} packets were lost: nobody read them", simulation.lost()));
    return exit_yes;
}

/// What the command line says over what the file says; throws what does not go together.
void apply(const SimulateOptions& options, SimulationSettings& settings) {
    if (options.seed) settings.seed = *options.seed;
    if (options.duration_s) settings.duration_s = *options.duration_s;
    if (!options.fast) return;
    if (options.record.empty()) throw std::runtime_error("--fast writes a recording only: add --record OUT.log");
    if (settings.duration_s <= 0) throw std::runtime_error("--fast needs an end: add --duration SECONDS");
}

int simulate_file(const SimulateOptions& options) try {
    if (options.reference) {
        fmt::print("{}", scenario_page());
        return exit_yes;
    }
    if (options.scenario.empty()) throw std::runtime_error("which scenario? see locus simulate --help");
    auto [scenario, problems] = load_scenario(options.scenario);
    for (const ConfigProblem& problem : problems) complain(to_string(problem));
    if (!scenario) return exit_usage;
    if (options.print_config) {
        fmt::print("{}", print_configuration(*scenario, options.socket));
        return exit_yes;
    }
    apply(options, scenario->simulation);
    return simulate_scenario(*scenario, options);
} catch (const std::runtime_error& error) {
    complain(error.what());
    return exit_usage;
}

} // namespace

void add_simulate(CLI::App& root, int& exit_code) {
    auto* const command = root.add_subcommand("simulate", "plays a scenario through simulated devices or into a file");
    const auto options = std::make_shared<SimulateOptions>();
    command->add_option("scenario", options->scenario, "scenario file (YAML)");
    command->add_option("--record", options->record, "also write what the devices send to this recording (*.log)");
    command->add_option("--truth", options->truth, "write where the targets truly are (TUM; OUT-NAME.tum for several)");
    command->add_option("--truth-rate", options->truth_rate_hz, "lines of truth a second")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
    command->add_option("--duration", options->duration_s, "seconds, instead of the scenario's")
        ->check(CLI::NonNegativeNumber);
    command->add_option("--seed", options->seed, "instead of the scenario's")->check(CLI::NonNegativeNumber);
    command->add_flag("--fast", options->fast, "as fast as possible, into the recording only");
    command->add_flag("--print-config", options->print_config,
                      "print the daemon's configuration for this scenario, and end");
    command->add_flag("--reference", options->reference, "print the page of everything a scenario can say, and end");
    command->add_option("--socket", options->socket, "socket to put into that configuration")->envname("LOCUS_SOCKET");
    command->footer("Examples:\n"
                    "  locus simulate hall.yaml --print-config > locusd.yaml\n"
                    "  locus simulate hall.yaml                     until Ctrl-C, for locusd to listen to\n"
                    "  locus simulate hall.yaml --fast --duration 60 --record hall.log --truth hall.tum\n"
                    "Exit codes: 0 it ran, 2 the scenario or an output cannot be used.");
    command->callback([options, &exit_code] { exit_code = simulate_file(*options); });
}

} // namespace locus
