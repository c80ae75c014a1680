#include "fusion/vision/anonymous.h"

#include <algorithm>
#include <charconv>

namespace locus::vision {
namespace {

constexpr std::uint64_t nobodys = 0xFFFFFFFE00000000, mask = 0xFFFFFFFF00000000;
constexpr unsigned camera_shift = 16;
constexpr std::uint64_t low_half = 0xFFFF;

char* write_number(char* begin, char* end, std::uint64_t number) noexcept {
    return std::to_chars(begin, end, number + 1).ptr; // people count from one
}

} // namespace

Address anonymous_address(Address camera, std::size_t place) noexcept {
    return address(nobodys | (number(camera) & low_half) << camera_shift | (place & low_half));
}

bool is_anonymous(Address target) noexcept { return (number(target) & mask) == nobodys; }

void write_anonymous_name(std::string& text, Address target) noexcept {
    constexpr std::string_view longest = "anonymous-65536-65536", start = "anonymous-";
    text = longest;
    char* const end = text.data() + text.size();
    char* at = write_number(text.data() + start.size(), end, number(target) >> camera_shift & low_half);
    *at++ = '-';
    at = write_number(at, end, number(target) & low_half);
    text.resize(static_cast<std::size_t>(at - text.data()));
}

std::optional<Address> AnonymousTargets::target_of(Address camera, std::uint32_t track, Timestamp time) noexcept {
    const auto is_his = [&](const Place& place) { return place.seen.has_value() && place.track == track; };
    const auto is_free = [&](const Place& place) { return !place.seen.has_value() || time - *place.seen > rest_; };
    auto place = std::find_if(places_.begin(), places_.end(), is_his);
    if (place == places_.end()) place = std::find_if(places_.begin(), places_.end(), is_free);
    if (place == places_.end()) return std::nullopt;
    *place = {track, time};
    return anonymous_address(camera, static_cast<std::size_t>(place - places_.begin()));
}

} // namespace locus::vision
