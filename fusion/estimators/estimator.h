// Estimator: measurements of one target in time order -> its state. One object per target; the timeline keeps copies
// of it as snapshots, so its memory is fixed at construction and copy_from() never allocates.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/option.h"
#include "fusion/pose.h"
#include "fusion/site.h"

#include <memory>
#include <span>
#include <string_view>

namespace locus {

class Estimator {
  public:
    virtual ~Estimator() = default;

    /// Takes one observation; `measurement.time` never goes back between calls. The same state and the same
    /// measurement give the same bits, always: no clock, no address, no global goes in.
    virtual Verdict update(const Measurement& measurement) noexcept = 0;

    /// The state carried forward to `time` (at or after the last update). Changes nothing.
    virtual Estimate predict(Timestamp time) const noexcept = 0;

    /// A second object of the same type, settings and state. May allocate; for construction only.
    virtual std::unique_ptr<Estimator> clone() const = 0;

    /// Takes the state of another object of the same type. Does not allocate.
    virtual void copy_from(const Estimator& other) noexcept = 0;
};

/// One row per estimator that a configuration can name.
struct EstimatorRow {
    std::string_view name;
    std::string_view about;
    OptionTable options;
    /// `site` outlives the estimator; `settings` is what options.make() gave, filled.
    std::unique_ptr<Estimator> (*make)(const Site& site, const void* settings);
    bool needs_origin = false; ///< the site must say where on the Earth it lies
};

std::span<const EstimatorRow> estimator_table();

/// nullptr when there is none of that name.
const EstimatorRow* find_estimator(std::string_view name);

} // namespace locus
