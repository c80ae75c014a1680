// Single points: one epoch of 7 satellites; then a whole recording (graphgnss_hk_tst, GPS, 1760 epochs) through the
// engine's receivers beside Debian's rnx2rtkp on the same files, per epoch. That is a program, so its processor time
// counts, less that of a run that reads the same files and solves one epoch only; it writes a line of text an epoch.
// Ours has the measurements in memory, and makes satellite ranges besides.
#include "drivers/recording/measurement_json.h"
#include "tests/replay/data.h"
#include "tests/replay/receiver_run.h"
#include "tests/replay/rnx2rtkp.h"
#include "tests/unit/fusion/gnss/synthetic_sky.h"
#include "tools/import/import.h"

#include <benchmark/benchmark.h>

#include <sys/resource.h>

namespace {

using namespace locus;

constexpr double epochs_of_recording = 1760;

std::vector<gnss::SightFrom> seven_sights() {
    std::vector<gnss::SightFrom> sights;
    for (const auto& raw : gnss::synthetic::epoch({}, gnss::synthetic::start))
        for (const auto& e : gnss::synthetic::satellites())
            if (sights.size() < 7 && e.constellation == raw.constellation && e.satellite == raw.satellite)
                sights.push_back({*gnss::sight_of(raw, gnss::Ephemeris{e})});
    return sights;
}

/// place_known 0: the solver begins at the centre of the Earth, as for the first epoch.
void epoch_of_seven(benchmark::State& state) {
    const gnss::synthetic::Truth truth;
    const gnss::SinglePointSolver solver{GnssSettings{}};
    const gnss::Sky sky{gnss::synthetic::start, gnss::synthetic::ionosphere};
    const auto sights = seven_sights();
    const Eigen::Vector3d near_m = state.range(0) == 0 ? Eigen::Vector3d(0, 0, 0) : truth.at(1);
    std::vector<gnss::SightFrom> epoch = sights;
    for (auto _ : state) {
        epoch = sights;
        benchmark::DoNotOptimize(solver.solve(epoch, sky, near_m));
    }
}
BENCHMARK(epoch_of_seven)->ArgName("place_known")->Arg(0)->Arg(1);

/// The same with the satellites' positions out of their ephemerides.
void epoch_of_seven_with_orbits(benchmark::State& state) {
    const gnss::synthetic::Truth truth;
    const gnss::SinglePointSolver solver{GnssSettings{}};
    const gnss::Sky sky{gnss::synthetic::start, gnss::synthetic::ionosphere};
    std::vector<std::pair<GnssRaw, gnss::Ephemeris>> heard;
    for (const auto& e : gnss::synthetic::satellites())
        if (heard.size() < 7 && gnss::synthetic::is_visible(e, truth, sky.time))
            heard.emplace_back(gnss::synthetic::observe(e, truth, sky.time), e);
    std::vector<gnss::SightFrom> epoch;
    epoch.reserve(heard.size());
    for (auto _ : state) {
        epoch.clear();
        for (const auto& [raw, ephemeris] : heard) epoch.push_back({*gnss::sight_of(raw, ephemeris)});
        benchmark::DoNotOptimize(solver.solve(epoch, sky, truth.at(1)));
    }
}
BENCHMARK(epoch_of_seven_with_orbits);

std::vector<std::string> files() {
    std::vector<std::string> paths;
    for (const char* name : {"COM3_190428_124409.obs", "hksc1180.19n"})
        if (const auto path = test::recorded(std::string("graphgnss_hk_tst/gps_solution_TST/") + name))
            paths.push_back(path->string());
    return paths.size() == 2 ? paths : std::vector<std::string>{};
}

void recording_ours(benchmark::State& state) {
    const test::TemporaryFolder folder;
    importing::Request request{files(), folder / "recording.jsonl"};
    if (request.files.empty()) return state.SkipWithError("no graphgnss_hk_tst");
    importing::import_files(request);
    std::vector<Measurement> measurements;
    std::ifstream file(request.output);
    std::string error;
    for (std::string line; std::getline(file, line);)
        if (const auto m = from_json_line(line, error)) measurements.push_back(*m);
    for (auto _ : state) {
        test::ReceiverRun run{GnssSettings{}};
        for (const Measurement& m : measurements) {
            const auto* raw = std::get_if<GnssRaw>(&m.observation);
            if (!raw || raw->constellation == constellation::gps) run.hear(m);
        }
        run.finish();
        benchmark::DoNotOptimize(run.fixes.data());
    }
    state.counters["per_epoch"] = benchmark::Counter(
        epochs_of_recording, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(recording_ours)->Unit(benchmark::kMillisecond);

double processor_time_of_children_s() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double run_s(const std::string& command) {
    const double before_s = processor_time_of_children_s();
    if (std::system((command + " >/dev/null 2>&1").c_str()) != 0) return 0;
    return processor_time_of_children_s() - before_s;
}

void recording_rnx2rtkp(benchmark::State& state) {
    const auto paths = files();
    if (paths.empty() || !test::rnx2rtkp_installed()) return state.SkipWithError("no graphgnss_hk_tst, or no rnx2rtkp");
    const test::TemporaryFolder folder;
    const std::string command = "rnx2rtkp -p 0 -m 10 -sys G -o " + folder / "out.pos",
                      read = " '" + paths[0] + "' '" + paths[1] + "'";
    for (auto _ : state) {
        const double all_s = run_s(command + read);
        const double one_s = run_s(command + " -ti 100000" + read);
        state.SetIterationTime(std::max(1e-9, all_s - one_s));
    }
    state.counters["per_epoch"] = benchmark::Counter(
        epochs_of_recording, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(recording_rnx2rtkp)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);

} // namespace
