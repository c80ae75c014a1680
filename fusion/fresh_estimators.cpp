#include "fusion/fresh_estimators.h"

#include <stdexcept>

namespace locus {

const FreshEstimators::Item& FreshEstimators::of(const std::string& name) {
    for (const auto& item : items_)
        if (item->row->name == name) return *item;
    items_.push_back(std::make_unique<Item>(make(name)));
    return *items_.back();
}

FreshEstimators::Item FreshEstimators::make(const std::string& name) const {
    for (const EstimatorSettings& given : settings_.estimators)
        if (given.row->name == name) return {given.row, given.row->make(settings_.site, given.settings.get())};
    const EstimatorRow* row = find_estimator(name);
    if (row == nullptr) throw std::invalid_argument("there is no estimator called \"" + name + "\"");
    return {row, row->make(settings_.site, row->options.make().get())};
}

} // namespace locus
