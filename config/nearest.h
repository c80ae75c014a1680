// The nearest valid name to a mistyped one, so that an error says what was meant and not only that it was wrong.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace locus::config {

/// Fewest insertions, deletions, substitutions and swaps of neighbours that make `a` of `b` (optimal string
/// alignment; Boytsov 2011, "Indexing methods for approximate dictionary searching", sec. 2.1). Letters' case is
/// ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate of least distance, when that is near enough to be meant (a third of the letters); else empty.
std::string_view nearest(std::string_view typed, std::span<const std::string_view> candidates);

/// `; did you mean "x"?`, else `; known here: x, y, z`.
std::string hint(std::string_view typed, std::span<const std::string_view> candidates);

} // namespace locus::config
