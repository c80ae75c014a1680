#include "drivers/uwb/apps_json.h"

#include "drivers/line_decoder.h"
#include "drivers/uwb/limits.h"
#include "drivers/wire/bytes.h"

#include <cmath>

namespace locus::uwb {
namespace {

/// Written so that a NaN is impossible as well.
bool is_possible_range(double range_m) { return range_m >= 0 && range_m < farthest_dw1000_m; }
bool is_possible_difference(double difference_m) { return std::abs(difference_m) < farthest_dw1000_m; }
/// Below the deepest mine, above the highest roof.
bool is_possible_pressure(double pressure_pa) { return pressure_pa > 30e3 && pressure_pa < 150e3; }

class AppsJson : public LineDecoder {
  public:
    explicit AppsJson(const AppsSettings& settings) : settings_{settings} {}

  protected:
    void line(std::string_view text, Timestamp begun, MeasurementSink& sink) override {
        const auto report = apps::parse(text);
        if (!report) return sink.refuse(Refusal::malformed);
        sink.frame(wire::bytes_of(text));
        if (const auto* ranges = std::get_if<apps::Ranges>(&*report)) tell(*ranges, begun, sink);
        if (const auto* differences = std::get_if<apps::Differences>(&*report)) tell(*differences, begun, sink);
    }

  private:
    void tell(const apps::Ranges& report, Timestamp time, MeasurementSink& sink) const {
        const Address node = report.node ? address(*report.node) : settings_.node;
        for (const auto& [peer, range_m] : report.items) {
            if (!is_possible_range(range_m)) {
                sink.refuse(Refusal::out_of_range);
                continue;
            }
            Range range;
            range.anchor = settings_.node_is_anchor ? node : address(peer);
            range.tag = settings_.node_is_anchor ? address(peer) : node;
            range.range_m = range_m;
            range.rx_power_dbm = report.rx_power_dbm;
            range.line_of_sight = report.line_of_sight;
            sink.accept(time, range);
        }
    }

    static void tell(const apps::Differences& report, Timestamp time, MeasurementSink& sink) {
        for (const auto& [anchor, difference_m] : report.items) {
            if (!is_possible_difference(difference_m)) {
                sink.refuse(Refusal::out_of_range);
                continue;
            }
            RangeDifference difference;
            difference.anchor_a = address(report.reference);
            difference.anchor_b = address(anchor);
            difference.tag = address(report.node);
            difference.difference_m = difference_m;
            sink.accept(time, difference);
        }
        if (!report.pressure_pa) return;
        if (!is_possible_pressure(*report.pressure_pa)) return sink.refuse(Refusal::out_of_range);
        Pressure pressure;
        pressure.tag = address(report.node);
        pressure.pressure_pa = *report.pressure_pa;
        sink.accept(time, pressure);
    }

    AppsSettings settings_;
};

} // namespace

std::unique_ptr<Decoder> make_apps_json(const void* settings) {
    return std::make_unique<AppsJson>(*static_cast<const AppsSettings*>(settings));
}

} // namespace locus::uwb
