// Reads and writes the fields of an NLink frame one after another. The two have the same functions, so that a layout is
// said once for both (nlink_layout.h).
#pragma once

#include "drivers/uwb/nlink_messages.h"
#include "drivers/wire/bytes.h"

#include <algorithm>

namespace locus::uwb::nlink {

class Reader {
  public:
    explicit Reader(wire::Bytes bytes) : bytes_(bytes) {}

    /// Whether everything was there, and nothing is left.
    bool whole() const { return good_ && at_ == bytes_.size(); }

    template <class T>
        requires std::is_arithmetic_v<T>
    void number(T& value) {
        value = wire::little<T>(bytes_, take(sizeof(T)));
    }
    void number(Role& role) { role = static_cast<Role>(wire::little<std::uint8_t>(bytes_, take(1))); }
    void int24(std::int32_t& value) {
        value = static_cast<std::int32_t>(wire::sign_extended(wire::little_bytes(bytes_, take(3), 3), 24));
    }
    void skip(std::size_t count) { take(count); }
    void data(std::span<const std::uint8_t>& data) {
        std::uint16_t length = 0;
        number(length);
        const std::size_t at = take(length);
        if (good_) data = bytes_.subspan(at, length);
    }

    /// A count, and so many elements.
    template <class T, std::size_t capacity, class Element>
    void list(List<T, capacity>& list, const Element& element) {
        std::uint8_t count = 0;
        number(count);
        for (; count > 0 && good_; --count) element(list.emplace_back());
    }
    /// Makes room for `size` elements that come one by one.
    template <class T, std::size_t capacity>
    void room(List<T, capacity>& list, std::size_t size) {
        good_ = good_ && size <= capacity;
        if (good_) list.resize(size);
    }

  private:
    wire::Bytes bytes_;
    std::size_t at_ = 0;
    bool good_ = true;

    /// Where the next `count` bytes begin.
    std::size_t take(std::size_t count) {
        good_ = good_ && count <= bytes_.size() - at_;
        const std::size_t at = at_;
        if (good_) at_ += count;
        return good_ ? at : bytes_.size();
    }
};

class Writer {
  public:
    std::vector<std::uint8_t> take() { return out_.take(); }

    template <class T>
        requires std::is_arithmetic_v<T>
    void number(T value) {
        out_.little(value);
    }
    void number(Role role) { out_.little(static_cast<std::uint8_t>(role)); }
    void int24(std::int32_t value) { out_.little_bytes(static_cast<std::uint32_t>(value), 3); }
    void skip(std::size_t count) { out_.zeros(count); }
    void data(std::span<const std::uint8_t> data) {
        out_.little(static_cast<std::uint16_t>(data.size()));
        out_.bytes(data);
    }

    template <class T, std::size_t capacity, class Element>
    void list(List<T, capacity>& list, const Element& element) {
        number(static_cast<std::uint8_t>(list.size()));
        std::for_each(list.begin(), list.end(), element);
    }
    template <class T, std::size_t capacity>
    void room(const List<T, capacity>& /*list*/, std::size_t /*size*/) {}

  private:
    wire::Writer out_;
};

} // namespace locus::uwb::nlink
