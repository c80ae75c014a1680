// Any bytes, or any CAN frames, as what somebody sniffs: what is guessed is a layout that the loader takes and that
// finds the frames again, and whatever is said can be said as JSON.
#include "config/load.h"
#include "tools/sniff/entry_lines.h"
#include "tools/sniff/listing.h"
#include "tools/sniff/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace {

using namespace locus;
using namespace locus::sniff;

/// The first byte says how long the chunks are and, with its highest bit, that they are CAN frames.
Capture capture_of(std::span<const std::uint8_t> bytes) {
    Capture capture;
    if (bytes.empty()) return capture;
    const bool can = bytes[0] & 0x80;
    const std::size_t length = can ? 10 : 1 + (bytes[0] & 0x7Fu);
    for (bytes = bytes.subspan(1); !bytes.empty(); bytes = bytes.subspan(std::min(length, bytes.size()))) {
        Packet packet;
        packet.time = timestamp_from_ns(std::int64_t{1'000'000} * static_cast<std::int64_t>(bytes.size()));
        packet.data = bytes.first(std::min(length, bytes.size()));
        if (can) {
            packet.wire = Wire::can;
            packet.can_id = static_cast<std::uint32_t>(wire::little_bytes(bytes, 0, 2)) & 0x7FF;
            packet.data = packet.data.subspan(std::min<std::size_t>(packet.data.size(), 2));
        }
        capture.packet(packet);
    }
    return capture;
}

void check_yaml(const std::string& yaml) {
    if (!load_settings_text(yaml, "pasted").settings) std::abort();
}

void list(const Capture& capture, const DecoderRow& row) {
    if (row.wire != capture.wire() || !row.options.lists.empty()) return;
    Listing listing{row, row.options.make().get(), 0, [](const Entry& entry) {
                        if (!nlohmann::json::parse(entry_json(entry, 0), nullptr, false).is_object()) std::abort();
                        if (entry_text(entry, 0).empty()) std::abort();
                    }};
    for (std::size_t i = 0; i < capture.packets(); ++i) listing.packet(capture.at(i));
    listing.finish();
    if (listing.skipped() > listing.bytes() || listing.bytes() != capture.bytes().size()) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Capture capture = capture_of({data, size});
    const Findings findings = look_into(capture);
    Source source;
    source.is_file = true;
    if (findings_lines(findings, source).empty()) std::abort();
    if (!nlohmann::json::parse(findings_json(findings, source), nullptr, false).is_object()) std::abort();
    if (findings.wire == Wire::bytes)
        for (const Standing& winner : findings.winners) check_yaml(input_yaml(winner, source));
    if (findings.guess) {
        check_yaml(input_yaml(*findings.guess, source));
        if (measured(findings.guess->layout, capture.bytes()).frames != findings.guess->frames) std::abort();
    }
    const auto table = decoder_table();
    if (size > 0) list(capture, table[data[size - 1] % table.size()]);
    return 0;
}
