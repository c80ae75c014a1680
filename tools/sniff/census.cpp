#include "tools/sniff/census.h"

#include "drivers/j1939/identifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace locus::sniff {
namespace {

constexpr std::size_t most_ids = 512, most_payloads = 100;

void add(Census& id, const Packet& packet) {
    const std::size_t size = packet.data.size();
    id.can_id = packet.can_id;
    id.shortest = id.frames == 0 ? size : std::min(id.shortest, size);
    id.longest = std::max(id.longest, size);
    ++id.frames;
    if (id.samples.size() < most_payloads) id.samples.emplace_back(packet.data.begin(), packet.data.end());
}

bool is_extended(const Census& id) { return (id.can_id & CAN_EFF_FLAG) != 0; }

bool is_group(const Census& id, std::uint32_t group) {
    const auto said = j1939::identifier(id.can_id);
    return said && said->group == group;
}

} // namespace

std::vector<Census> census(const Capture& capture) {
    std::map<std::uint32_t, Census> ids;
    std::map<std::uint32_t, std::pair<Timestamp, Timestamp>> times;
    for (std::size_t i = 0; i < capture.packets(); ++i) {
        const Packet packet = capture.at(i);
        if (ids.size() >= most_ids && !ids.contains(packet.can_id)) continue;
        add(ids[packet.can_id], packet);
        times.try_emplace(packet.can_id, packet.time, packet.time).first->second.second = packet.time;
    }
    std::vector<Census> all;
    for (auto& [can_id, id] : ids) {
        const auto [first, last] = times[can_id];
        if (last > first) id.rate_hz = static_cast<double>(id.frames - 1) / to_s(last - first);
        all.push_back(std::move(id));
    }
    return all;
}

std::vector<std::string> looks_like(const std::vector<Census>& ids) {
    std::vector<std::string> sentences;
    const auto any = [&](const auto& is) { return std::ranges::any_of(ids, is); };
    if (any([](const Census& id) { return is_group(id, 0xEC00) || is_group(id, 0xEB00); }))
        sentences.emplace_back("J1939: messages longer than a frame go over the bus (groups EC00, EB00)");
    else if (!ids.empty() && std::ranges::all_of(ids, is_extended))
        sentences.emplace_back("J1939 perhaps: every identifier has 29 bits");
    if (any([](const Census& id) { return is_group(id, 0xEF00) && (id.can_id & 0xFF) == 0x80; }))
        sentences.emplace_back("a PulsON radio perhaps: group EF00 from address 80 (decoder pulson_can)");
    if (any([](const Census& id) { return id.can_id >= 0x7E8 && id.can_id <= 0x7EF; }))
        sentences.emplace_back("a vehicle that somebody asks by OBD-II (decoder obd2)");
    return sentences;
}

std::string id_text(std::uint32_t can_id) {
    return can_id & CAN_EFF_FLAG ? fmt::format("{:08X}", can_id & CAN_EFF_MASK)
                                 : fmt::format("{:03X}", can_id & CAN_SFF_MASK);
}

} // namespace locus::sniff
