// The range message of protocols.md E-4e (CALC), which each transport carries in its own envelope.
#pragma once

#include "drivers/uwb/pulson/messages.h"

namespace locus::uwb::pulson {

inline const FullRange computed_range{.message = 7,
                                      .responder = 101,
                                      .stopwatch_ms = 20,
                                      .precise_mm = 5234,
                                      .coarse_mm = 5300,
                                      .filtered_mm = 5240,
                                      .precise_sigma_mm = 21,
                                      .coarse_sigma_mm = 150,
                                      .filtered_sigma_mm = 25,
                                      .velocity_mmps = -120,
                                      .velocity_sigma_mmps = 40,
                                      .parts = precise,
                                      .requester_edge = line_of_sight,
                                      .responder_edge = line_of_sight,
                                      .noise = 210,
                                      .peak = 4200,
                                      .coarse_flight_bins = 571,
                                      .timestamp = 123456};

} // namespace locus::uwb::pulson
