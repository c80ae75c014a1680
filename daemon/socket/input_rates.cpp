#include "daemon/socket/input_rates.h"

#include <algorithm>

namespace locus {

InputRates::Counts InputRates::counts_of(const InputStatus& status) {
    return {status.bytes, status.packets, status.frames, status.measurements};
}

void InputRates::watch(const std::vector<InputEntry>& inputs, Timestamp now) {
    if (last_ && now - *last_ < step) return;
    last_ = now;
    std::map<const InputStatus*, Watched> kept;
    for (const InputEntry& input : inputs) {
        if (!input.status) continue;
        Watched& watched = kept[input.status.get()];
        watched = std::move(inputs_[input.status.get()]);
        watched.status = input.status;
        watched.looks.push_back({now, counts_of(*input.status)});
        if (watched.looks.size() > steps_kept) watched.looks.pop_front();
    }
    inputs_ = std::move(kept);
}

std::optional<InputRate> InputRates::rate(const InputStatus& status, Timestamp now) const {
    const auto found = inputs_.find(&status);
    if (found == inputs_.end() || now - found->second.looks.front().time < step) return std::nullopt;
    const Look& before = found->second.looks.front();
    const Counts counts = counts_of(status);
    std::array<double, 4> rates{};
    for (std::size_t i = 0; i < rates.size(); ++i)
        rates[i] = static_cast<double>(counts[i] - before.counts[i]) / to_s(now - before.time);
    return InputRate{rates[0], rates[1], rates[2], rates[3]};
}

} // namespace locus
