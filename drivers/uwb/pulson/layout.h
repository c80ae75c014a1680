// One description of a message serves both ways: each struct of messages.h names its fields in the order of the wire,
// and a reader or a writer goes through them. All numbers are big-endian, on every line (protocols.md 3.1).
#pragma once

#include "drivers/wire/bytes.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <optional>

namespace locus::uwb::pulson {

/// Bytes that mean nothing.
struct Reserved {
    std::size_t count;
};

/// An array of which the first `count` are sent; `count` was sent before.
template <class Items, class Count>
struct Counted {
    Items& items;
    const Count& count;
};
template <class Items, class Count>
Counted(Items&, const Count&) -> Counted<Items, Count>;

/// Bytes of a count that was sent before; `size` of them an item.
template <class View, class Count>
struct Tail {
    View& bytes;
    const Count& count;
    std::size_t size;
};
template <class View, class Count>
Tail(View&, const Count&, std::size_t) -> Tail<View, Count>;

class FieldReader {
  public:
    explicit FieldReader(wire::Bytes message) : message_{message} {}

    template <class... Fields>
    void operator()(Fields&&... fields) {
        (one(std::forward<Fields>(fields)), ...);
    }

    /// Whether the message was exactly as long as its fields, and no count beyond what there is room for.
    bool fits() const { return counts_fit_ && at_ == message_.size(); }

  private:
    template <std::integral T>
    void one(T& value) {
        value = wire::big<T>(message_, at_);
        at_ += sizeof value;
    }
    template <std::size_t size>
    void one(std::array<char, size>& text) {
        for (char& letter : text) one(letter);
    }
    void one(const Reserved& reserved) { at_ += reserved.count; }

    template <class Items, class Count>
    void one(const Counted<Items, Count>& counted) {
        counts_fit_ = counts_fit_ && counted.count <= counted.items.size();
        if (!counts_fit_) return;
        for (std::size_t i = 0; i < counted.count; ++i) Items::value_type::layout(*this, counted.items[i]);
    }
    template <class View, class Count>
    void one(const Tail<View, Count>& tail) {
        counts_fit_ = counts_fit_ && at_ <= message_.size();
        const std::size_t left = counts_fit_ ? message_.size() - at_ : 0;
        counts_fit_ = counts_fit_ && left % tail.size == 0 && left / tail.size == tail.count;
        if (!counts_fit_) return;
        tail.bytes = message_.subspan(at_);
        at_ = message_.size();
    }

    wire::Bytes message_;
    std::size_t at_ = 0;
    bool counts_fit_ = true;
};

class FieldWriter {
  public:
    template <class... Fields>
    void operator()(const Fields&... fields) {
        (one(fields), ...);
    }
    std::vector<std::uint8_t> take() { return out_.take(); }

  private:
    template <std::integral T>
    void one(const T& value) {
        out_.big(value);
    }
    template <std::size_t size>
    void one(const std::array<char, size>& text) {
        for (const char letter : text) one(letter);
    }
    void one(const Reserved& reserved) { out_.zeros(reserved.count); }
    template <class Items, class Count>
    void one(const Counted<Items, Count>& counted) {
        for (std::size_t i = 0; i < counted.count; ++i)
            std::decay_t<Items>::value_type::layout(*this, counted.items[i]);
    }
    template <class View, class Count>
    void one(const Tail<View, Count>& tail) {
        out_.bytes(tail.bytes);
    }

    wire::Writer out_;
};

/// The message, from its type on and without an envelope. Empty when its type is another or its length does not fit.
/// Views inside it are of `bytes`.
template <class Message>
std::optional<Message> parse(wire::Bytes bytes) {
    FieldReader fields{bytes};
    Message message;
    Message::layout(fields, message);
    const bool known = std::ranges::find(Message::types, message.type) != Message::types.end();
    return known && fields.fits() ? std::optional{message} : std::nullopt;
}

/// As it stands on the wire, without an envelope.
template <class Message>
std::vector<std::uint8_t> encode(const Message& message) {
    FieldWriter fields;
    Message::layout(fields, message);
    return fields.take();
}

} // namespace locus::uwb::pulson
