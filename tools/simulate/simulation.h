// The scenario as it runs: sensors measure moving targets at their rates, and what they send goes to the outputs.
#pragma once

#include "tools/simulate/frame_writer.h"
#include "tools/simulate/output.h"
#include "tools/simulate/schedule.h"

#include <functional>
#include <memory>
#include <ostream>
#include <vector>

namespace locus::simulate {

class Simulation {
  public:
    /// Its time 0 is `start`. `scenario` outlives it.
    Simulation(const Scenario& scenario, Timestamp start);
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Sends what the sensor (its place in the scenario) sends there as well. Before the first step.
    void add_output(std::size_t sensor, std::unique_ptr<Output> output);

    /// Writes where the target (its place in the scenario) truly is. Before the first step; `stream` outlives it.
    void add_truth(std::size_t mover, double rate_hz, std::ostream& stream);

    /// When the next thing happens, and doing it. A measurement's time is when the host receives it.
    Timestamp next() const { return start_ + duration_from_s(schedule_.next_s()); }
    void step() { schedule_.act(); }

    /// What was measured, and what no reader took.
    std::uint64_t epochs() const { return epochs_; }
    std::uint64_t lost() const;

  private:
    struct Device : PacketSink {
        Receiver receiver;
        std::unique_ptr<FrameWriter> writer;
        std::vector<std::unique_ptr<Output>> outputs;
        std::vector<unsigned> sequences; ///< of each mover

        Device(const Scenario& scenario, const Sensor& sensor, unsigned number);
        void packet(const Packet& packet) override;
    };

    const Scenario& scenario_;
    Timestamp start_;
    Schedule schedule_;
    std::vector<Target> targets_;
    std::vector<std::unique_ptr<Device>> devices_;
    std::uint64_t epochs_ = 0;

    void add_sensor(const Sensor& sensor, unsigned number);
    void measure(Device& device, const Sensor& sensor, std::size_t mover, double arrival_s);
};

} // namespace locus::simulate
