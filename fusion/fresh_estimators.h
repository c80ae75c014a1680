// Estimators in their first state, one for each name that the settings use. Targets begin as clones of them, and one
// that lost its way is set back to them.
#pragma once

#include "fusion/engine.h"

#include <memory>
#include <string>
#include <vector>

namespace locus {

class FreshEstimators {
  public:
    struct Item {
        const EstimatorRow* row;
        std::unique_ptr<Estimator> estimator;
    };

    /// `settings` and its site outlive all that is made here.
    explicit FreshEstimators(const EngineSettings& settings) : settings_(settings) {}

    /// Rows that the settings bring along go before those of estimator_table(). The reference stays good.
    /// Throws std::invalid_argument when there is none of that name.
    const Item& of(const std::string& name);

  private:
    Item make(const std::string& name) const;

    const EngineSettings& settings_;
    std::vector<std::unique_ptr<Item>> items_;
};

} // namespace locus
