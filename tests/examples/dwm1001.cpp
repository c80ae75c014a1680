#include "drivers/uwb/dwm1001_shell.h"
#include "drivers/uwb/dwm1001_tlv.h"

#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> dwm1001() {
    using namespace uwb::dwm1001;
    DecoderExample shell{"dwm1001_shell"}, tlv{"dwm1001_tlv"};
    for (int i = 0; i < 20; ++i) {
        ShellLine line;
        line.kind = i % 2 == 0 ? ShellLine::Kind::lec : ShellLine::Kind::les;
        line.distances.push_back({0x2F2F, {305, 268, 0}, 221 + i});
        line.distances.push_back({0x2C9D, {-4, 291, 0}, 239});
        line.position = Position{{159, 165, 127}, 44};
        shell.chunks.push_back(chunk(encode(line)));
        TlvReply reply;
        reply.from = TlvReply::From::tag;
        reply.position = {{1590, 1650, 1270}, 44};
        reply.distances.push_back({0x2F2F, 2210u + static_cast<unsigned>(i), 100, {{3050, 2680, 0}, 100}});
        reply.distances.push_back({0x2C9D, 2390, 100, {{-40, 2910, 0}, 100}});
        tlv.chunks.push_back(encode(reply));
    }
    shell.lines = true;
    tlv.apart = std::chrono::milliseconds{200};
    shell.checksum = tlv.checksum = false;
    return {shell, tlv};
}

} // namespace locus::examples
