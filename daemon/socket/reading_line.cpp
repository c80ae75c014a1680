#include "daemon/socket/reading_line.h"

#include "daemon/socket/json_text.h"

namespace locus {

std::string open_reading_line(const ReadingItem& reading, const Names& names) {
    std::string line = R"({"class":"READING","target":)";
    append_text(line, names.target(reading.tag));
    line += R"(,"time":)";
    append_fixed(line, to_s(reading.time), 9);
    line += R"(,"beacon":)";
    append_text(line, address_text(reading.beacon));
    line += R"(,"name":)";
    append_text(line, names.source(SourceKind::anchor, reading.beacon));
    line += R"(,"rssi_dbm":)";
    append_fixed(line, double{reading.rssi_dbm}, 1);
    return line;
}

} // namespace locus
