// Key -> small number in memory that is set aside once: a sorted array, because a site has tens of anchors and
// hundreds of tags, and the fusion thread may not allocate.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace locus {

template <class Key>
class FlatIndex {
  public:
    static constexpr std::uint16_t none = 0xFFFF;

    explicit FlatIndex(std::size_t capacity) : capacity_(capacity) { rows_.reserve(capacity); }

    /// The number that `key` was put under, or `none`.
    std::uint16_t find(const Key& key) const noexcept {
        const auto row = place(key);
        return row != rows_.end() && row->first == key ? row->second : none;
    }

    /// False when there is no room left; the key must not be there yet.
    bool put(const Key& key, std::uint16_t value) noexcept {
        if (rows_.size() == capacity_) return false;
        rows_.insert(place(key), {key, value});
        return true;
    }

  private:
    using Row = std::pair<Key, std::uint16_t>;

    auto place(const Key& key) const noexcept {
        return std::lower_bound(rows_.begin(), rows_.end(), key,
                                [](const Row& row, const Key& wanted) { return row.first < wanted; });
    }

    std::size_t capacity_;
    std::vector<Row> rows_;
};

} // namespace locus
