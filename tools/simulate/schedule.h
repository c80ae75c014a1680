// Things that happen at fixed rates, in order of time: sensors that measure, truth that is written down.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace locus::simulate {

class Schedule {
  public:
    /// `act(time_s)` at first_s, first_s + period_s, ... (period_s > 0).
    void add(double first_s, double period_s, std::function<void(double time_s)> act) {
        streams_.push_back({first_s, period_s, 0, std::move(act)});
    }

    /// When the next thing happens; there must be one.
    double next_s() const { return streams_[earliest()].time_s(); }

    /// Does it. Of things at one time, the one added first comes first.
    void act() {
        Stream& stream = streams_[earliest()];
        const double time_s = stream.time_s();
        ++stream.count;
        stream.act(time_s);
    }

  private:
    struct Stream {
        double first_s, period_s;
        std::int64_t count; ///< multiplied, not summed, so that no error grows
        std::function<void(double)> act;

        double time_s() const { return first_s + static_cast<double>(count) * period_s; }
    };
    std::vector<Stream> streams_;

    std::size_t earliest() const {
        const auto first = std::ranges::min_element(streams_, {}, &Stream::time_s);
        return static_cast<std::size_t>(first - streams_.begin());
    }
};

} // namespace locus::simulate
