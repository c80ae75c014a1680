#include "fusion/gnss/lnav_ionosphere.h"

#include "fusion/gnss/lnav.h"
#include "fusion/gnss/message_fields.h"

namespace locus::gnss {
namespace {

constexpr unsigned page_number = 56; ///< SV (page) ID of page 18, table 20-V
constexpr unsigned subframe_number = 4;
constexpr std::uint32_t of_gps = 1, of_qzss = 3; ///< data ID

/// Table 20-X: powers of two of the scale factors.
template <class Walk, ConstOrNot<Klobuchar> K>
void walk_ionosphere(Walk& walk, K& k) {
    constexpr std::array<int, 4> alpha{-30, -27, -24, -24}, beta{11, 14, 16, 16};
    for (std::size_t i = 0; i < 4; ++i) {
        walk.scaled_signed(k.alpha[i], {{0, 56 + 8 * i, 8}}, alpha[i]);
        walk.scaled_signed(k.beta[i], {{0, 88 + 8 * i, 8}}, beta[i]);
    }
}

} // namespace

std::optional<Klobuchar> lnav_ionosphere(const MessageBits& subframe) noexcept {
    const std::uint32_t data_id = subframe.get(48, 2);
    const bool is_page = lnav_subframe_number(subframe) == subframe_number && subframe.get(50, 6) == page_number &&
                         (data_id == of_gps || data_id == of_qzss);
    if (!is_page) return std::nullopt;
    Klobuchar coefficients;
    const FieldReader reader{std::span{&subframe, 1}};
    walk_ionosphere(reader, coefficients);
    return coefficients;
}

std::optional<MessageBits> encode_lnav_ionosphere(const Klobuchar& coefficients, const GpsTime& sent) noexcept {
    MessageBits page{240};
    FieldWriter writer{std::span{&page, 1}};
    walk_ionosphere(writer, coefficients);
    if (!writer.fits()) return std::nullopt;
    stamp_lnav(page, subframe_number, sent);
    return page.set(48, 2, of_gps).set(50, 6, page_number);
}

} // namespace locus::gnss
