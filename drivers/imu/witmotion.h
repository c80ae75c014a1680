// WitMotion modules (JY901, WT901, HWT...) on a serial line and on CAN: protocols.md 4.1 and 4.2. Acceleration, rate,
// angle and the rest come in small frames of their own, cycle after cycle; a sample is the acceleration (0x51) and the
// rate (0x52) of one cycle, taken when the first byte of the acceleration went out. The magnetic field is left out:
// its scale is not public for most of them.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/imu/mounting.h"

namespace locus::imu {

/// What serial frames and CAN frames share; the serial frame alone has the fourth word and a checksum.
struct WitFrame {
    enum Type : std::uint8_t {
        time = 0x50,
        acceleration = 0x51,
        rate = 0x52,
        angle = 0x53,
        field = 0x54,
        port = 0x55,
        pressure = 0x56,
        first = time,
        last = 0x5F
    };
    std::uint8_t type = acceleration;
    std::array<std::int16_t, 4> words{};

    bool operator==(const WitFrame&) const = default;
};

inline constexpr std::size_t wit_frame_length = 11;

/// A whole serial frame, its checksum already looked at.
WitFrame parse_wit_frame(std::span<const std::uint8_t, wit_frame_length> bytes);

std::array<std::uint8_t, wit_frame_length> encode(const WitFrame& frame);
/// The fourth word has no place in it.
CanFrame encode_can(const WitFrame& frame, int can_id);

/// In the sensor's axes, rounded to the steps of the format and held to its limits (16 g, 2000 deg/s).
WitFrame wit_acceleration(const Vec3& force_mps2);
WitFrame wit_rate(const Vec3& rate_radps);
WitFrame wit_pressure(std::int32_t pressure_pa);

struct WitMotionSettings : MountingSettings {};

inline constexpr auto witmotion_options = mounting_options<WitMotionSettings>;

struct WitMotionCanSettings : MountingSettings {
    int can_id = 0x50;
};

inline constexpr std::array witmotion_can_own_options{
    option<&WitMotionCanSettings::can_id>("can_id", "", 0, 0x7FF,
                                          "11-bit identifier of the module's frames. The default 0x50 (80) is from "
                                          "memory, no document of the maker was found: see what the bus shows."),
};
inline constexpr auto witmotion_can_options = joined(mounting_options<WitMotionCanSettings>, witmotion_can_own_options);

/// Puts together what belongs to one cycle.
class WitSample {
  public:
    explicit WitSample(const MountingSettings& settings) : mounting_(settings) {}

    void take(const WitFrame& frame, Timestamp begun, MeasurementSink& sink);
    /// What comes next may belong to another cycle.
    void forget() { has_acceleration_ = false; }

  private:
    Mounting mounting_;
    WitFrame acceleration_{};
    Timestamp begun_{};
    bool has_acceleration_ = false;

    void give(const WitFrame& rate, MeasurementSink& sink);
};

/// Gives an ImuSample per cycle, and a Pressure per frame 0x56.
std::unique_ptr<Decoder> make_witmotion(const void* settings);
/// The same without pressure: a CAN frame has no room for it. There is no checksum.
std::unique_ptr<Decoder> make_witmotion_can(const void* settings);

} // namespace locus::imu
