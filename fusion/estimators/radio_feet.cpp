// Whom a camera sees is where his feet are (paper 003 eq. 6), but for what the camera does not know: how far the radio
// is beside them, and whether they are his. So they weigh the cloud as radios do, and are refused for a while where
// they are far off it.
#include "fusion/estimators/foot_evidence.h"
#include "fusion/estimators/radio_particles.h"

#include <Eigen/LU>

#include <algorithm>

namespace locus {
namespace {

/// The error that stays from image to image is shared among as many of them as come while it stays, so that all
/// together say what one would. What fades as e^(-t/T) is worth a new one every 2 T.
Eigen::Matrix2d with_error(const FootPoint& foot, double sigma_m, double share) noexcept {
    constexpr double least_m2 = 1e-4; // no camera knows feet to less than a centimetre
    return covariance_of(foot) + std::max(sigma_m * sigma_m, least_m2) / share * Eigen::Matrix2d::Identity();
}

} // namespace

Verdict RadioParticles::see(const FootPoint& foot, Timestamp time) noexcept {
    if (!is_sound(foot)) return {Exclusion::not_finite};
    const Eigen::Matrix2d covariance_m2 = with_error(foot, settings_.foot_error_sigma_m, 1);
    if (state_.missing != Missing::nothing) {
        stand_on(foot, covariance_m2, time);
        return {};
    }
    walk_.advance(time);
    const Verdict verdict = judge_feet(foot, covariance_m2);
    if (verdict.test_ratio <= 1) {
        const double share =
            std::max(1e-6, double{new_share(state_.believed_feet, time, 2 * settings_.foot_error_time_s)});
        weigh_feet(foot, with_error(foot, settings_.foot_error_sigma_m, share));
        state_.believed_feet = time;
        state_.refused_feet.reset();
        return verdict;
    }
    if (is_patient(time)) return kept_out(verdict);
    ++state_.reset_count;
    stand_on(foot, covariance_m2, time);
    return verdict;
}

Verdict RadioParticles::judge_feet(const FootPoint& foot, const Eigen::Matrix2d& covariance_m2) const noexcept {
    const Eigen::Vector2d at_m = walk_.local({foot.position_site_m[0], foot.position_site_m[1], 0});
    return judge_on_floor(at_m - cloud().mean().head<2>(), covariance_m2 + cloud().covariance().topLeftCorner<2, 2>(),
                          feet_gate_in_sigma_);
}

bool RadioParticles::is_seen(Timestamp time) const noexcept {
    return state_.believed_feet.has_value() && to_s(time - *state_.believed_feet) <= settings_.foot_error_time_s;
}

/// A moment, and it may be somebody else; for longer, and the cloud is wrong.
bool RadioParticles::is_patient(Timestamp time) noexcept {
    const bool goes_on =
        state_.refused_feet.has_value() && to_s(time - state_.refused_feet->last) <= settings_.foot_patience_s;
    if (!goes_on) state_.refused_feet = Refused{time, time};
    state_.refused_feet->last = time;
    return to_s(time - state_.refused_feet->first) < settings_.foot_patience_s;
}

/// The cloud anew, about the feet.
void RadioParticles::stand_on(const FootPoint& foot, const Eigen::Matrix2d& covariance_m2, Timestamp time) noexcept {
    filter::Particles::Vector4 mean = filter::Particles::Vector4::Zero();
    mean.head<2>() = walk_.local({foot.position_site_m[0], foot.position_site_m[1], 0});
    filter::Particles::Matrix4 covariance = filter::Particles::Matrix4::Identity();
    covariance *= settings_.speed_sigma_mps * settings_.speed_sigma_mps;
    covariance.topLeftCorner<2, 2>() = covariance_m2;
    walk_.particles().start(mean, covariance);
    walk_.begin_anew(time);
    state_.missing = Missing::nothing;
    state_.doubt = 0;
    state_.believed_feet = time;
    state_.refused_feet.reset();
}

void RadioParticles::weigh_feet(const FootPoint& foot, const Eigen::Matrix2d& covariance_m2) noexcept {
    const Eigen::Matrix2f information = covariance_m2.inverse().cast<float>();
    const Eigen::Vector2f at = walk_.local({foot.position_site_m[0], foot.position_site_m[1], 0}).cast<float>();
    walk_.particles().weigh_places([&](float x, float y) {
        const float dx = x - at.x(), dy = y - at.y();
        return -0.5F * (information(0, 0) * dx * dx + 2 * information(0, 1) * dx * dy + information(1, 1) * dy * dy);
    });
    walk_.settle();
}

} // namespace locus
