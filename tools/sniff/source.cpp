#include "tools/sniff/source.h"

#include "config/load.h"
#include "tools/sniff/files.h"
#include "tools/sniff/settings_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

namespace locus::sniff {
namespace {

namespace fs = std::filesystem;

Source source_of(std::string_view transport) {
    Source source;
    source.transport = find_transport(transport);
    source.transport_settings = source.transport->options.make();
    return source;
}

Source with_path(std::string_view transport, const std::string& path) {
    Source source = source_of(transport);
    set_option(source.transport->options, source.transport_settings.get(), "path", path);
    return source;
}

std::string names_of(const std::vector<InputSettings>& inputs) {
    std::vector<std::string_view> names;
    for (const InputSettings& input : inputs) names.push_back(input.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

const InputSettings* named(const std::vector<InputSettings>& inputs, const std::string& name) {
    const auto found = std::ranges::find(inputs, name, &InputSettings::name);
    return found == inputs.end() ? nullptr : &*found;
}

void take_decoder(Source& source, const InputSettings& input) {
    source.decoder = input.decoder;
    source.decoder_settings = input.decoder_settings;
}

/// What Linux calls ARPHRD_CAN.
bool is_can_interface(const std::string& name) {
    std::ifstream file{"/sys/class/net/" + name + "/type"};
    int type = 0;
    return file >> type && type == 280;
}

bool looks_like_can(const std::string& name) { return name.starts_with("can") || name.starts_with("vcan"); }

std::optional<Source> tcp_source(std::string_view rest, std::string& error) {
    const std::size_t colon = rest.rfind(':');
    int port = 0;
    const std::string_view digits = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
    std::from_chars(digits.begin(), digits.end(), port);
    Source source = source_of("tcp");
    const bool good =
        colon != std::string_view::npos && colon > 0 &&
        set_option(source.transport->options, source.transport_settings.get(), "host",
                   std::string{rest.substr(0, colon)}) &&
        set_option(source.transport->options, source.transport_settings.get(), "port", std::int64_t{port});
    if (good) return source;
    error = fmt::format("'tcp:{}' is not like tcp:192.168.1.5:4001", rest);
    return std::nullopt;
}

/// A line of text is needed to be told apart from raw bytes: a recording's name ends in .log.
std::optional<Source> file_source(const SourceRequest& request, std::string& error) {
    Source source;
    if (request.input.ends_with(".log")) {
        const auto input = recorded_input(request.input, request.recorded, error);
        if (!input) return std::nullopt;
        source = with_path("recording", request.input);
        set_option(source.transport->options, source.transport_settings.get(), "input", *input);
        set_option(source.transport->options, source.transport_settings.get(), "speed", 0.0);
    }
    source.path = request.input;
    source.is_file = true;
    return source;
}

std::optional<Source> path_source(const SourceRequest& request, std::string& error) {
    const std::string& path = request.input;
    switch (fs::status(path).type()) {
    case fs::file_type::regular:
        return file_source(request, error);
    case fs::file_type::fifo:
        return with_path("fifo", path);
    case fs::file_type::character:
        return with_path(fs::canonical(path).string().starts_with("/dev/pts/") ? "pty" : "serial", path);
    default:
        error = fmt::format("'{}' is neither a serial device, a pipe nor a file", path);
        return std::nullopt;
    }
}

std::optional<Source> device_source(const SourceRequest& request, std::string& error) {
    const std::string& name = request.input;
    if (name.starts_with("tcp:")) return tcp_source(std::string_view{name}.substr(4), error);
    if (std::error_code failed; fs::exists(name, failed)) return path_source(request, error);
    if (name.find('/') == std::string::npos && (is_can_interface(name) || looks_like_can(name))) {
        Source source = source_of("can");
        set_option(source.transport->options, source.transport_settings.get(), "interface", name);
        return source;
    }
    error = "'" + name + "' ";
    error +=
        name.starts_with("/dev/")
            ? "is not there: is it plugged in? `ls -l /dev/locus /dev/serial/by-id` shows what is"
            : "is no device, file, CAN interface or tcp:host:port; for the name of an input give --config FILE as well";
    return std::nullopt;
}

std::optional<Source> configured_source(const SourceRequest& request, std::string& error) {
    LoadResult loaded = load_settings(request.config);
    if (!loaded.settings) {
        error = to_string(loaded.problems.front()) + " (`locus check` says all)";
        return std::nullopt;
    }
    const auto& inputs = loaded.settings->inputs;
    if (const InputSettings* input = named(inputs, request.input)) {
        Source source;
        source.transport = input->transport;
        source.transport_settings = input->transport_settings;
        source.is_file = input->transport->name == "recording";
        take_decoder(source, *input);
        return source;
    }
    auto source = device_source(request, error);
    if (!source) {
        error = fmt::format("'{}' is no input of '{}' (it has: {}), nor a device or file", request.input,
                            request.config, names_of(inputs));
        return std::nullopt;
    }
    if (const InputSettings* input = named(inputs, request.recorded)) take_decoder(*source, *input);
    return source;
}

bool put_decoder(Source& source, const std::string& name, std::string& error) {
    source.decoder = find_decoder(name);
    if (!source.decoder) {
        error = fmt::format("there is no decoder '{}'; `locus config --reference` lists them", name);
        return false;
    }
    source.decoder_settings = source.decoder->options.make();
    const auto check = source.decoder->options.check;
    const std::string wrong = check ? check(source.decoder_settings.get()) : "";
    if (!wrong.empty())
        error =
            fmt::format("decoder {} needs settings of its own: write them into a file and give --config FILE", name);
    return wrong.empty();
}

/// The name of a device that stays the same when it is plugged in elsewhere or after another one.
std::string stable_name(const std::string& path) {
    std::error_code failed;
    const fs::path device = fs::canonical(path, failed);
    if (failed || path.starts_with("/dev/locus/") || path.starts_with("/dev/serial/")) return path;
    for (const char* folder : {"/dev/locus", "/dev/serial/by-id", "/dev/serial/by-path"})
        for (const auto& entry : fs::directory_iterator(folder, failed))
            if (fs::canonical(entry.path(), failed) == device && !failed) return entry.path().string();
    return path;
}

/// A file does not say what it was recorded from.
std::vector<std::string> lines_of_a_device(const DecoderRow& decoder) {
    if (decoder.wire == Wire::can) return {"transport: can", "interface: can0 # or whatever it was recorded from"};
    if (decoder.datagrams) return {"transport: udp", "port: 21211 # the one that it sends to"};
    return {"transport: serial", "path: /dev/serial/by-id/... # the device that it was recorded from"};
}

} // namespace

std::unique_ptr<Transport> Source::make_transport() const {
    return transport ? transport->make(transport_settings.get()) : raw_file(path);
}

std::vector<std::string> Source::lines(const DecoderRow& reader) const {
    if (is_file) return lines_of_a_device(reader);
    std::vector<std::string> lines{fmt::format("transport: {}", transport->name)};
    for (const std::string& line : settings_lines(transport->options, transport_settings.get())) {
        const std::string value = line.substr(line.find(": ") + 2);
        const bool is_device = has_baud_rate() && line.starts_with("path: \"");
        lines.push_back(is_device ? "path: " + stable_name(value.substr(1, value.size() - 2)) : line);
    }
    return lines;
}

void Source::set_baud_rate(int baud_bd) {
    const auto own = transport->options.make();
    for (const OptionRow& row : transport->options.rows) row.set(own.get(), row.get(transport_settings.get()));
    transport_settings = own;
    set_option(transport->options, transport_settings.get(), "baud_bd", std::int64_t{baud_bd});
}

std::optional<Source> find_source(const SourceRequest& request, std::string& error) {
    auto source = request.config.empty() ? device_source(request, error) : configured_source(request, error);
    if (!source) return std::nullopt;
    if (!request.decoder.empty() && !put_decoder(*source, request.decoder, error)) return std::nullopt;
    if (source->decoder && source->transport && !source->transport->carries(source->decoder->wire)) {
        error = fmt::format("decoder {} does not read what '{}' gives", source->decoder->name, request.input);
        return std::nullopt;
    }
    if (request.baud_bd == 0) return source;
    if (!source->has_baud_rate()) {
        error = fmt::format("'{}' has no baud rate", request.input);
        return std::nullopt;
    }
    source->set_baud_rate(request.baud_bd);
    return source;
}

} // namespace locus::sniff
