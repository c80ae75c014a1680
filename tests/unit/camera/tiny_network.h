// Networks small enough to be written out by hand: the picture's own pixels are the predictions.
#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace locus::camera::test {

/// Protocol buffers' wire format, as far as ONNX needs it here (onnx.proto3 has the numbers of the fields).
inline std::string varint(std::uint64_t value) {
    std::string bytes;
    for (; value > 127; value >>= 7) bytes += static_cast<char>(0x80 | (value & 127));
    return bytes + static_cast<char>(value);
}
inline std::string number(std::uint64_t field, std::uint64_t value) { return varint(field << 3) + varint(value); }
inline std::string part(std::uint64_t field, const std::string& content) {
    return varint(field << 3 | 2) + varint(content.size()) + content;
}
template <class Value>
std::string raw(const std::vector<Value>& values) {
    std::string bytes(values.size() * sizeof(Value), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

inline std::string node(const std::string& type, const std::vector<std::string>& inputs, const std::string& output) {
    std::string content;
    for (const auto& input : inputs) content += part(1, input);
    return part(1, content + part(2, output) + part(4, type));
}
inline std::string tensor_type(const std::string& name, const std::vector<std::int64_t>& shape) {
    std::string dimensions;
    for (const auto size : shape) dimensions += part(1, number(1, static_cast<std::uint64_t>(size)));
    return part(1, name) + part(2, part(1, number(1, 1) + part(2, dimensions)));
}

/// Input 1x3x32x32; output: its values times 32, in `shape` of 3072 numbers.
inline void write_onnx(const std::string& path, const std::vector<std::int64_t>& shape) {
    constexpr std::uint64_t is_float = 1, is_int64 = 7;
    const std::string shape_constant =
        number(1, shape.size()) + number(2, is_int64) + part(8, "shape") + part(9, raw(shape));
    const std::string factor = number(1, 1) + number(2, is_float) + part(8, "factor") + part(9, raw<float>({32}));
    const std::string graph = node("Reshape", {"picture", "shape"}, "numbers") +
                              node("Mul", {"numbers", "factor"}, "boxes") + part(2, "tiny") + part(5, shape_constant) +
                              part(5, factor) + part(11, tensor_type("picture", {1, 3, 32, 32})) +
                              part(12, tensor_type("boxes", shape));
    std::ofstream(path, std::ios::binary) << number(1, 7) << part(7, graph) << part(8, number(2, 11));
}

/// 4 x 4 places, at each a person of 12 x 24 px in the middle, whatever the picture shows.
inline void write_darknet(const std::string& config, const std::string& weights) {
    std::ofstream(config) << "[net]\nwidth=32\nheight=32\nchannels=3\n"
                             "[convolutional]\nfilters=6\nsize=1\nstride=8\npad=0\nactivation=linear\n"
                             "[yolo]\nmask=0\nanchors=12,24\nclasses=1\nnum=1\n";
    std::vector<float> numbers{0, 0, 0, 0, 5, 5}; // biases: middle of the place, size of the anchor, surely there
    numbers.resize(6 + 6 * 3, 0);
    std::ofstream(weights, std::ios::binary) << raw<std::int32_t>({0, 2, 0, 0, 0}) << raw(numbers);
}

} // namespace locus::camera::test
