// VectorNav binary messages: groups, masks and the fields of the common group.
#include "drivers/imu/vectornav.h"
#include "drivers/wire/checksum.h"

#include <bit>

namespace locus::imu {
namespace {

/// Lengths of the fields of each group, by their bit (protocols.md 4.6).
using FieldLengths = std::span<const std::uint8_t>;
constexpr std::uint8_t common_lengths[]{8, 8, 8, 12, 16, 12, 24, 12, 12, 24, 20, 28, 2, 4, 8};
constexpr std::uint8_t time_lengths[]{8, 8, 8, 2, 8, 8, 8, 4, 4, 1};
constexpr std::uint8_t imu_lengths[]{2, 12, 12, 12, 4, 4, 16, 12, 12, 12, 12, 2, 40};
constexpr std::uint8_t gps_lengths[]{8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28};
constexpr std::uint8_t attitude_lengths[]{2, 12, 16, 36, 12, 12, 12, 12, 12, 12, 28, 24, 12};
constexpr std::uint8_t ins_lengths[]{2, 24, 24, 12, 12, 12, 12, 12, 12, 4, 4, 68, 64};
constexpr std::array<FieldLengths, 7> group_lengths{common_lengths,   time_lengths, imu_lengths, gps_lengths,
                                                    attitude_lengths, ins_lengths,  gps_lengths};

/// Fields of the common group that we take, by their bit.
enum CommonField : unsigned {
    startup_field = 0,
    rate_field = 5,
    force_field = 8,
    uncorrected_field = 9,
    magnetic_field = 10
};

constexpr std::size_t groups_at = 1, masks_at = 2, crc_length = 2;

constexpr std::size_t length_of_fields(FieldLengths lengths, unsigned mask) {
    std::size_t sum = 0;
    for (std::size_t bit = 0; bit < lengths.size(); ++bit) sum += (mask >> bit & 1) * lengths[bit];
    return sum;
}

/// Empty when the mask names a field that does not exist.
constexpr std::optional<std::size_t> payload_length(FieldLengths lengths, unsigned mask) {
    if (mask >> lengths.size() != 0) return std::nullopt;
    return length_of_fields(lengths, mask);
}

constexpr std::size_t longest_message() {
    std::size_t sum = masks_at + crc_length;
    for (const FieldLengths lengths : group_lengths) sum += 2 + length_of_fields(lengths, (1u << lengths.size()) - 1);
    return sum;
}
static_assert(longest_message() <= longest_vectornav_message);

std::size_t masks_end(wire::Bytes bytes) {
    return masks_at + 2 * static_cast<std::size_t>(std::popcount(bytes[groups_at]));
}

Vec3 read_floats(wire::Bytes bytes, std::size_t at) {
    Vec3 vector{};
    for (std::size_t i = 0; i < 3; ++i) vector[i] = static_cast<double>(wire::little<float>(bytes, at + 4 * i));
    return vector;
}

/// Fields come in the order of their bits, so the corrected values are there before the uncorrected.
void read_field(unsigned field, wire::Bytes bytes, std::size_t at, VectorNavData& data) {
    switch (field) {
    case startup_field:
        data.time_startup_ns = wire::little<std::uint64_t>(bytes, at);
        break;
    case rate_field:
        data.rate_radps = read_floats(bytes, at);
        break;
    case force_field:
        data.acceleration_mps2 = read_floats(bytes, at);
        break;
    case uncorrected_field:
        if (!data.acceleration_mps2) data.acceleration_mps2 = read_floats(bytes, at);
        if (!data.rate_radps) data.rate_radps = read_floats(bytes, at + 12);
        break;
    case magnetic_field: // gauss, degrees Celsius, kilopascal
        data.magnetic_gauss = read_floats(bytes, at);
        data.pressure_kpa = static_cast<double>(wire::little<float>(bytes, at + 16));
        break;
    default:
        break;
    }
}

void write_floats(wire::Writer& out, const Vec3& vector) {
    for (const double value : vector) out.little(static_cast<float>(value));
}

} // namespace

std::optional<std::size_t> vectornav_length(wire::Bytes bytes) {
    if (bytes.size() <= groups_at) return std::nullopt;
    const unsigned groups = bytes[groups_at];
    if (groups == 0 || groups >> group_lengths.size() != 0) return 0;
    if (bytes.size() < masks_end(bytes)) return std::nullopt;
    std::size_t length = masks_end(bytes) + crc_length;
    std::size_t mask_at = masks_at;
    for (std::size_t group = 0; group < group_lengths.size(); ++group) {
        if ((groups >> group & 1) == 0) continue;
        const auto payload = payload_length(group_lengths[group], wire::little<std::uint16_t>(bytes, mask_at));
        if (!payload) return 0;
        length += *payload;
        mask_at += 2;
    }
    return length;
}

VectorNavData parse_vectornav(wire::Bytes bytes) {
    VectorNavData data;
    if ((bytes[groups_at] & 1) == 0) return data;
    const unsigned mask = wire::little<std::uint16_t>(bytes, masks_at);
    std::size_t at = masks_end(bytes);
    for (unsigned field = 0; field < std::size(common_lengths); ++field) {
        if ((mask >> field & 1) == 0) continue;
        read_field(field, bytes, at, data);
        at += common_lengths[field];
    }
    return data;
}

std::vector<std::uint8_t> encode(const VectorNavData& data) {
    const bool has_magnetic = data.magnetic_gauss || data.pressure_kpa;
    const auto bit = [](bool has, unsigned field) { return static_cast<unsigned>(has) << field; };
    wire::Writer body;
    body.little(std::uint8_t{1});
    body.little(static_cast<std::uint16_t>(
        bit(data.time_startup_ns.has_value(), startup_field) | bit(data.rate_radps.has_value(), rate_field) |
        bit(data.acceleration_mps2.has_value(), force_field) | bit(has_magnetic, magnetic_field)));
    if (data.time_startup_ns) body.little(*data.time_startup_ns);
    if (data.rate_radps) write_floats(body, *data.rate_radps);
    if (data.acceleration_mps2) write_floats(body, *data.acceleration_mps2);
    if (has_magnetic) {
        write_floats(body, data.magnetic_gauss.value_or(Vec3{}));
        body.little(0.0f).little(static_cast<float>(data.pressure_kpa.value_or(0))); // temperature before it
    }
    const std::uint16_t crc = wire::crc16_xmodem(body.written());
    return wire::Writer{}.little(vectornav_head).bytes(body.written()).big(crc).take();
}

} // namespace locus::imu
