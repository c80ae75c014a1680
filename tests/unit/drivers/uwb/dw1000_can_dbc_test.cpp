// The DBC file and the decoder must say the same: frames with random bits are read by the rules of the DBC file
// (protocols.md 6.5) and by the decoder.
#include "drivers/uwb/dw1000_can.h"

#include "tests/support/source_folder.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <string>

namespace locus::uwb {
namespace {

struct DbcSignal {
    unsigned start, length;
    bool is_signed;
    double factor, offset, minimum, maximum;

    double value(std::uint64_t word) const {
        double raw = 0;
        for (unsigned i = 0; i < length; ++i) raw += word >> (start + i) & 1 ? std::ldexp(1, static_cast<int>(i)) : 0;
        if (is_signed && (word >> (start + length - 1) & 1)) raw -= std::ldexp(1, static_cast<int>(length));
        return raw * factor + offset;
    }
    bool allows(double value) const { return value >= minimum - 1e-9 && value <= maximum + 1e-9; }
};

using DbcMessage = std::map<std::string, DbcSignal>;

std::map<unsigned, DbcMessage> read_dbc() {
    const std::regex message(R"(^BO_ (\d+) \w+: 8 .*)");
    const std::regex signal(R"(^ SG_ (\w+) : (\d+)\|(\d+)@1([+-]) \(([^,]+),([^)]+)\) \[([^|]+)\|([^\]]+)\] .*)");
    std::ifstream file(test::source_folder() + "/drivers/uwb/dw1000_can.dbc");
    std::map<unsigned, DbcMessage> messages;
    DbcMessage* current = nullptr;
    std::smatch m;
    for (std::string line; std::getline(file, line);) {
        const auto integer = [&](std::size_t i) { return static_cast<unsigned>(std::stoul(m[i])); };
        if (std::regex_match(line, m, message))
            current = &messages[integer(1)];
        else if (current != nullptr && std::regex_match(line, m, signal))
            (*current)[m[1]] = {integer(2),      integer(3),      m[4] == "-",    std::stod(m[5]),
                                std::stod(m[6]), std::stod(m[7]), std::stod(m[8])};
    }
    return messages;
}

class Dw1000CanDbc : public ::testing::Test {
  protected:
    const std::map<unsigned, DbcMessage> dbc = read_dbc();

    /// Decodes random words that the DBC file allows a measurement in, and hands value getter and result to `check`.
    template <class Kind, class Check>
    void each(unsigned id, const char* length_name, Check check) {
        const DbcMessage& message = dbc.at(id);
        EXPECT_TRUE(rc::check([&] {
            const auto word = *rc::gen::arbitrary<std::uint64_t>() * 0x9E3779B97F4A7C15u;
            const auto value = [&](const char* name) { return message.at(name).value(word); };
            CanFrame frame{id, 8, {}};
            for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(word >> (8 * i));
            test::Collector sink;
            test::default_decoder("dw1000_can")->decode(frame.packet({}), sink);
            const bool allowed = message.at(length_name).allows(value(length_name)) &&
                                 message.at("LineOfSight").allows(value("LineOfSight"));
            RC_ASSERT(sink.items.size() == (allowed ? 1u : 0u));
            if (!allowed) return;
            const auto& sample = std::get<Kind>(sink.items[0].observation);
            check(sample, value);
            RC_ASSERT(static_cast<double>(number(sample.tag)) == value("Tag"));
            RC_ASSERT(static_cast<double>(sample.line_of_sight) == value("LineOfSight"));
            RC_ASSERT(agrees(sample.sigma_m, message.at("Sigma"), value("Sigma")));
        }));
    }

    /// Equal, or not known where the DBC file allows no value.
    static bool agrees(float decoded, const DbcSignal& signal, double value) {
        return signal.allows(value) ? std::abs(decoded - value) < 1e-6 * (1 + std::abs(value)) : std::isnan(decoded);
    }
};

TEST_F(Dw1000CanDbc, DescribesBothFramesAtTheDefaultIdentifiers) {
    ASSERT_EQ(dbc.size(), 2u);
    EXPECT_EQ(dbc.begin()->first, static_cast<unsigned>(Dw1000CanSettings{}.base_id));
    for (const auto& [id, message] : dbc) EXPECT_EQ(message.size(), 7u);
}

TEST_F(Dw1000CanDbc, RangesAreReadAlike) {
    each<Range>(832, "Range", [&](const Range& range, const auto& value) {
        RC_ASSERT(static_cast<double>(number(range.anchor)) == value("Anchor"));
        RC_ASSERT(std::abs(range.range_m - value("Range")) < 1e-9);
        RC_ASSERT(agrees(range.rx_power_dbm, dbc.at(832).at("RxPower"), value("RxPower")));
    });
}

TEST_F(Dw1000CanDbc, DifferencesAreReadAlike) {
    each<RangeDifference>(833, "Difference", [&](const RangeDifference& difference, const auto& value) {
        RC_ASSERT(static_cast<double>(number(difference.anchor_a)) == value("AnchorA"));
        RC_ASSERT(static_cast<double>(number(difference.anchor_b)) == value("AnchorB"));
        RC_ASSERT(std::abs(difference.difference_m - value("Difference")) < 1e-9);
    });
}

} // namespace
} // namespace locus::uwb
