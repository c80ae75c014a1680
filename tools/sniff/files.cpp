#include "tools/sniff/files.h"

#include "drivers/recording/log_line.h"
#include "tools/client/fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <fstream>
#include <set>

namespace locus::sniff {
namespace {

constexpr std::size_t lines_looked_at = 100'000, most_inputs = 64;

class RawFile : public Transport {
  public:
    explicit RawFile(std::string path) : path_{std::move(path)} {}

    bool open() override {
        file_ = std::ifstream{path_, std::ios::binary};
        if (!file_) error_ = "'" + path_ + "' cannot be read: no such file, or no permission";
        return static_cast<bool>(file_);
    }
    void close() override { file_.close(); }
    ReadStatus read(PacketSink& sink, Duration /*timeout*/) override {
        std::array<char, 4096> chunk{};
        file_.read(chunk.data(), chunk.size());
        if (file_.gcount() == 0) return ReadStatus::ended;
        Packet packet;
        packet.data = {reinterpret_cast<const std::uint8_t*>(chunk.data()), static_cast<std::size_t>(file_.gcount())};
        sink.packet(packet);
        return ReadStatus::ok;
    }
    std::string_view last_error() const override { return error_; }

  private:
    std::string path_;
    std::ifstream file_;
    std::string error_;
};

std::set<std::string> inputs_of(const std::string& path) {
    std::set<std::string> inputs;
    std::ifstream file{path};
    std::string line, error;
    for (std::size_t i = 0; i < lines_looked_at && inputs.size() < most_inputs && std::getline(file, line); ++i)
        if (const auto record = from_log_line(line, error)) inputs.insert(record->input);
    return inputs;
}

} // namespace

std::unique_ptr<Transport> raw_file(const std::string& path) { return std::make_unique<RawFile>(path); }

std::optional<std::string> recorded_input(const std::string& path, const std::string& wanted, std::string& error) {
    const auto inputs = inputs_of(path);
    if (inputs.contains(wanted)) return wanted;
    if (wanted.empty() && inputs.size() == 1) return *inputs.begin();
    const std::string names = tools::printable(fmt::format("{}", fmt::join(inputs, ", ")));
    if (inputs.empty())
        error = fmt::format("'{}' is no recording: no line of it is like (12.345678) uwb serial#4D43; a file of raw "
                            "bytes must not end in .log",
                            path);
    else if (wanted.empty())
        error = fmt::format("'{}' holds several inputs: say which with --input, one of {}", path, names);
    else
        error = fmt::format("'{}' holds no input '{}', but {}", path, wanted, names);
    return std::nullopt;
}

} // namespace locus::sniff
