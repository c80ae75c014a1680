// Handover: objects too large or too complex for a ring go from one thread to another by pointer, and their ownership
// with them. Neither side frees what the other still holds.
#pragma once

#include "fusion/ring.h"

#include <memory>

namespace locus {

template <class Item, std::size_t Capacity = 8>
class Handover {
  public:
    Handover() = default;
    Handover(const Handover&) = delete;
    Handover& operator=(const Handover&) = delete;
    ~Handover() {
        while (take()) {
        }
    }

    /// Producer side. False when full: the item stays with the caller.
    bool give(std::unique_ptr<Item>& item) noexcept {
        if (!ring_.push(item.get())) return false;
        static_cast<void>(item.release());
        return true;
    }

    /// Consumer side; null when there is none.
    std::unique_ptr<Item> take() noexcept {
        Item* item = nullptr;
        ring_.pop(item);
        return std::unique_ptr<Item>{item};
    }

  private:
    Ring<Item*, Capacity> ring_;
};

} // namespace locus
