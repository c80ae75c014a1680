// The reference page of scenario files, from the tables that they are read by.
#include "config/print_options.h"
#include "tools/simulate/scenario.h"

#include <fmt/format.h>

namespace locus::simulate {
namespace {

constexpr std::string_view introduction = R"(# Scenarios

Made from the option tables: `locus simulate --reference > docs/scenario.md` writes this page anew.

A scenario is what `locus simulate` plays: a site, walls that shadow, targets that move, sensors that measure them. It is one
YAML file, checked like the daemon's settings; `config/examples/demo-scenario.yaml` is a whole one. What the sensors send are the
bytes of the real devices, so the daemon listens to them with its ordinary transports and decoders:

    locus simulate hall.yaml --print-config > locusd.yaml     the configuration that fits
    locus simulate hall.yaml                                  plays it, in real time
    locus simulate hall.yaml --fast --duration 60 --record hall.log --truth hall.tum

Same seed, same bytes. A device that nobody reads loses what it sends, as a real one does. Transports `pty` (made here, with a
link at its `path`), `fifo` and `can` can be simulated, and the decoders `trek1000` and `dw1000_can`.
)";

template <class Settings>
std::string section(std::string_view name, std::string_view about, Options rows) {
    const Settings defaults;
    return fmt::format("\n## {}\n\n{}\n{}", name, about, config::reference_table({rows, &defaults}));
}

} // namespace

std::string scenario_page() {
    std::string page(introduction);
    page += section<SimulationSettings>("simulation", "The run as a whole.", simulation_options);
    page += "\n## site\n\nAs in the daemon's settings: the anchors, and where they stand.\n";
    page += section<Wall>("walls", "A list of what radio passes late, or not at all; each item:", wall_options);
    page += section<Motion>("targets",
                            "A list of what moves. Each item has name, address and estimator as in the daemon's "
                            "settings, a list `waypoints_site_m` of points [x, y, z] that it goes round, and:",
                            motion_options);
    page += section<Radio>("sensors",
                           "A list. Each item is an input as in the daemon's settings, with the options of its "
                           "transport and decoder, and:",
                           radio_options);
    return page;
}

} // namespace locus::simulate
