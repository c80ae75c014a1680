#include "config/nearest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace locus::config {
namespace {

constexpr std::size_t longest_name = 64; // a longer word is no typing error of a name; the table below stays small

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool same(char a, char b) { return lower(a) == lower(b); }

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    if (a.size() > longest_name || b.size() > longest_name) return std::max(a.size(), b.size());
    std::array<std::array<std::size_t, longest_name + 1>, longest_name + 1> cost{};
    for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = cost[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, substituted});
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    return cost[a.size()][b.size()];
}

std::string_view nearest(std::string_view typed, std::span<const std::string_view> candidates) {
    std::string_view best;
    std::size_t least = longest_name;
    for (const auto candidate : candidates) {
        const std::size_t distance = edit_distance(typed, candidate);
        const bool near_enough = distance <= std::max<std::size_t>(1, std::max(typed.size(), candidate.size()) / 3);
        if (near_enough && distance < least) {
            best = candidate;
            least = distance;
        }
    }
    return best;
}

std::string hint(std::string_view typed, std::span<const std::string_view> candidates) {
    if (const auto best = nearest(typed, candidates); !best.empty()) return fmt::format("; did you mean \"{}\"?", best);
    if (candidates.empty()) return "; none are known here";
    return fmt::format("; known here: {}", fmt::join(candidates, ", "));
}

} // namespace locus::config
