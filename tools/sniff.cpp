// locus sniff: what comes out of this cable? Frame by frame with a decoder, else who understands it and how to set it
// up.
#include "drivers/clock.h"
#include "tools/client/command.h"
#include "tools/command.h"
#include "tools/interrupt.h"
#include "tools/show/terminal.h"
#include "tools/sniff/baud.h"
#include "tools/sniff/entry_lines.h"
#include "tools/sniff/listing.h"
#include "tools/sniff/report.h"

#include <fmt/format.h>

#include <charconv>
#include <memory>

namespace locus {
namespace {

using namespace locus::sniff;
using tools::complain;

constexpr Duration sniff_read_timeout = std::chrono::milliseconds{100};
constexpr double listen_s = 5, listen_to_rate_s = 2;
constexpr std::size_t enough_of_a_rate = 4096;

struct SniffOptions {
    SourceRequest request;
    std::string baud;
    double seconds = 0; ///< 0: not given
    std::uint64_t count = 0;
    bool ask = false;
    bool json = false;
};

/// Reads until `enough`, the time is over (of a device; a file is read to its end), or Ctrl-C. False when it was lost.
template <class Enough>
bool listen(Transport& transport, PacketSink& sink, std::optional<double> seconds, const Enough& enough) {
    const Timestamp begun = monotonic_now();
    ReadStatus status = ReadStatus::ok;
    while (status == ReadStatus::ok && !tools::interrupted() && !enough() &&
           (!seconds || monotonic_now() - begun < duration_from_s(*seconds)))
        status = transport.read(sink, sniff_read_timeout);
    if (status == ReadStatus::lost) complain(std::string{transport.last_error()});
    return status != ReadStatus::lost;
}

std::unique_ptr<Transport> opened(const Source& source) {
    auto transport = source.make_transport();
    if (transport->open()) return transport;
    const std::string error{transport->last_error()};
    complain(error);
    if (error.find("in use") != std::string::npos)
        complain(
            "if it is locusd: `sudo systemctl stop locusd`, or have it record (locusd --record hall.log) and sniff "
            "the recording: locus sniff hall.log");
    return nullptr;
}

std::optional<double> time_limit(const SniffOptions& options, const Source& source, std::optional<double> otherwise) {
    if (source.is_file) return std::nullopt;
    return options.seconds > 0 ? options.seconds : otherwise;
}

int list_frames(const SniffOptions& options, const Source& source) {
    const auto transport = opened(source);
    if (!transport) return exit_usage;
    EntryLines lines{options.json};
    Listing listing{*source.decoder, source.decoder_settings.get(), options.count,
                    [&](const Entry& entry) { lines.print(entry); }};
    const auto enough = [&] {
        if (options.ask && !source.is_file)
            if (const auto request = listing.request(monotonic_now())) transport->write(*request);
        return listing.full();
    };
    listen(*transport, listing, time_limit(options, source, std::nullopt), enough);
    listing.finish();
    lines.print_summary(listing);
    if (listing.bytes() == 0 && !options.ask && listing.request(monotonic_now()))
        complain("this device speaks when it is asked: add --ask");
    return listing.tally().frames > 0 ? exit_yes : exit_no;
}

/// What comes at one rate; nothing when the port cannot be opened, or somebody pressed Ctrl-C.
std::optional<Capture> listen_at(const Source& source, int baud_bd) {
    Source at_rate = source;
    at_rate.set_baud_rate(baud_bd);
    const auto transport = opened(at_rate);
    if (!transport || tools::interrupted()) return std::nullopt;
    Capture capture;
    const bool well =
        listen(*transport, capture, listen_to_rate_s, [&] { return capture.bytes().size() >= enough_of_a_rate; });
    complain(fmt::format("{} Bd: {} bytes", baud_bd, capture.bytes().size()));
    return well ? std::optional{std::move(capture)} : std::nullopt;
}

bool put_baud_rate(Source& source) {
    if (!source.has_baud_rate()) return complain("--baud auto is for serial ports"), false;
    const auto found = find_baud_rate([&](int baud_bd) { return listen_at(source, baud_bd); });
    if (!found) return complain("no rate gives anything but noise"), false;
    complain(fmt::format("{} Bd it is: {}", found->baud_bd,
                         found->winners.empty() ? "there the bytes have the most structure"
                                                : "there they are " + std::string{found->winners[0].decoder->name}));
    source.set_baud_rate(found->baud_bd);
    return true;
}

int find_out(const SniffOptions& options, const Source& source) {
    const auto transport = opened(source);
    if (!transport) return exit_usage;
    Capture capture;
    const auto seconds = time_limit(options, source, listen_s);
    if (seconds) complain(fmt::format("listening for {:g} s; Ctrl-C ends it earlier", *seconds));
    listen(*transport, capture, seconds, [&] { return capture.full(); });
    if (capture.empty()) {
        complain("nothing came. Is the device switched on? Some speak only when they are asked: --decoder NAME --ask");
        return exit_no;
    }
    const Findings findings = look_into(capture);
    if (options.json)
        fmt::print("{}\n", findings_json(findings, source));
    else
        tools::print_lines(findings_lines(findings, source));
    return findings.any() ? exit_yes : exit_no;
}

/// "auto" is left to later. False when it is no number.
bool read_baud(SniffOptions& options) {
    if (options.baud.empty() || options.baud == "auto") return true;
    const auto [end, error] =
        std::from_chars(&*options.baud.begin(), &*options.baud.begin() + options.baud.size(), options.request.baud_bd);
    if (error == std::errc{} && *end == '\0' && options.request.baud_bd > 0) return true;
    complain(fmt::format("--baud is a number such as 115200, or auto; not '{}'", options.baud));
    return false;
}

int sniff_command(SniffOptions options) {
    std::string error;
    if (!read_baud(options)) return exit_usage;
    auto source = find_source(options.request, error);
    if (!source) {
        complain(error);
        return exit_usage;
    }
    tools::catch_interrupts();
    if (options.baud == "auto" && !put_baud_rate(*source)) return exit_no;
    return source->decoder ? list_frames(options, *source) : find_out(options, *source);
}

} // namespace

void add_sniff(CLI::App& root, int& exit_code) {
    auto options = std::make_shared<SniffOptions>();
    CLI::App& app =
        *root.add_subcommand("sniff", "Says what comes out of a cable: which device it is, or frame by frame");
    app.add_option("INPUT", options->request.input,
                   "Serial port, pty, pipe, CAN interface, tcp:host:port, recording (.log), file of raw bytes, or the "
                   "name of an input of --config")
        ->required();
    app.add_option("--config", options->request.config, "Configuration that names the input")->type_name("FILE");
    app.add_option("--decoder", options->request.decoder, "Decoder to read it with; left out: it is found out")
        ->type_name("NAME");
    app.add_option("--input", options->request.recorded, "Which input of a recording")->type_name("NAME");
    app.add_option("--baud", options->baud, "Baud rate of a serial port; auto: the usual ones are tried")
        ->type_name("BD");
    app.add_option("--seconds", options->seconds, "How long to listen; left out: 5, and with a decoder until Ctrl-C")
        ->type_name("S")
        ->check(CLI::PositiveNumber);
    app.add_option("--count", options->count, "Stop after so many frames")->type_name("N")->check(CLI::PositiveNumber);
    app.add_flag("--ask", options->ask, "Let the decoder ask the device, for those that speak only then");
    app.add_flag("--json", options->json, "Print JSON: a line a frame, or one object with all that was found");
    app.footer("Only the port that is named is opened, and unless --ask is given nothing is written to it.\n"
               "Example:\n  locus sniff /dev/ttyUSB0 --baud auto\n"
               "  locus sniff /dev/ttyACM0 --decoder trek1000 --count 20\n"
               "  locus sniff can0\n"
               "  locus sniff uwb --config /etc/locusd/locusd.yaml --seconds 10\n"
               "  locus sniff hall.log --input uwb\n"
               "Without a decoder it needs a few frames: --seconds 30 for a device that speaks once in a while.\n"
               "Exit codes: 0 it is understood (or its frames are found), 1 not, 2 wrong use or it cannot be opened.");
    app.callback([options, &exit_code] { exit_code = sniff_command(*options); });
}

} // namespace locus
