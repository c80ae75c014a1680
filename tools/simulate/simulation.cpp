#include "tools/simulate/simulation.h"

#include "tools/simulate/truth.h"

namespace locus::simulate {

Simulation::Device::Device(const Scenario& scenario, const Sensor& sensor, unsigned number)
    : receiver(scenario, sensor.radio, number), writer(make_frame_writer(scenario, sensor)),
      sequences(scenario.movers.size()) {}

void Simulation::Device::packet(const Packet& packet) {
    for (const auto& output : outputs) output->packet(packet);
}

Simulation::Simulation(const Scenario& scenario, Timestamp start) : scenario_(scenario), start_(start) {
    for (const Mover& mover : scenario.movers) targets_.emplace_back(mover.motion);
    for (std::size_t i = 0; i < scenario.sensors.size(); ++i) add_sensor(scenario.sensors[i], static_cast<unsigned>(i));
}

void Simulation::add_sensor(const Sensor& sensor, unsigned number) {
    devices_.push_back(std::make_unique<Device>(scenario_, sensor, number));
    Device& device = *devices_.back();
    const double period_s = 1 / (sensor.radio.rate_hz * (1 + sensor.radio.clock_drift_ppm * 1e-6));
    // Targets take turns, as in a superframe.
    const double slot_s = period_s / static_cast<double>(scenario_.movers.size());
    for (std::size_t mover = 0; mover < scenario_.movers.size(); ++mover)
        schedule_.add(sensor.input.delay_s + static_cast<double>(mover) * slot_s, period_s,
                      [this, &device, &sensor, mover](double time_s) { measure(device, sensor, mover, time_s); });
}

void Simulation::measure(Device& device, const Sensor& sensor, std::size_t mover, double arrival_s) {
    const double sample_s = arrival_s - sensor.input.delay_s;
    Epoch epoch;
    epoch.arrival = start_ + duration_from_s(arrival_s);
    epoch.device_s = sample_s * (1 + sensor.radio.clock_drift_ppm * 1e-6);
    epoch.tag = scenario_.movers[mover].target.address;
    epoch.sequence = device.sequences[mover]++;
    epoch.observations = device.receiver.measure(mover, targets_[mover].at(sample_s).position_site_m);
    ++epochs_;
    if (!epoch.observations.empty()) device.writer->write(epoch, device);
}

void Simulation::add_output(std::size_t sensor, std::unique_ptr<Output> output) {
    devices_[sensor]->outputs.push_back(std::move(output));
}

void Simulation::add_truth(std::size_t mover, double rate_hz, std::ostream& stream) {
    schedule_.add(0, 1 / rate_hz, [this, mover, &stream](double time_s) {
        stream << tum_line(start_ + duration_from_s(time_s), targets_[mover].at(time_s));
    });
}

std::uint64_t Simulation::lost() const {
    std::uint64_t lost = 0;
    for (const auto& device : devices_)
        for (const auto& output : device->outputs) lost += output->lost();
    return lost;
}

} // namespace locus::simulate
