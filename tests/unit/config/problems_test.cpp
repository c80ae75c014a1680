// Each kind of mistake in a settings file has its own sentence, its place, and the nearest valid name.
#include "load_fixture.h"

#include <gtest/gtest.h>

namespace locus {
namespace {

struct Case {
    const char* name;
    const char* yaml;
    const char* problem;
};

const Case cases[] = {
    // Unknown keys.
    {"UnknownSection", "fusoin: {}", R"(1:1: the file has no setting "fusoin"; did you mean "fusion"?)"},
    {"UnknownKey", "fusion:\n  rate_hs: 5", R"(2:3: fusion has no setting "rate_hs"; did you mean "rate_hz"?)"},
    {"UnknownKeyFarFromAll", "log: {colour: red}", R"(1:7: log has no setting "colour"; known here: level)"},
    {"UnknownEstimatorSection", "estimators: {rnage_ekf: {}}",
     R"(1:14: there is no estimator "rnage_ekf"; did you mean "range_ekf"?)"},
    // Wrong types.
    {"TextForNumber", "fusion: {rate_hz: fast}", R"(1:19: rate_hz must be a number in Hz; here stands "fast")"},
    {"QuotedNumber", "fusion: {rate_hz: \"50\"}", R"(1:19: rate_hz must be a number in Hz; here stands the text "50")"},
    {"UnitBehindNumber", "fusion: {rate_hz: 50 Hz}", R"(1:19: rate_hz must be a number in Hz; here stands "50 Hz")"},
    {"InfinityForNumber", "fusion: {window_s: .inf}", R"(1:20: window_s must be a number in s; here stands ".inf")"},
    {"FractionForWhole", "fusion: {max_targets: 2.5}",
     R"(1:23: max_targets must be a whole number; here stands "2.5")"},
    {"NumberForBool", "realtime: {lock_memory: 1}", R"(1:25: lock_memory must be true or false; here stands "1")"},
    {"ListForText", "publish: {socket: [a]}", R"(1:19: socket must be text; here stands a list)"},
    {"NothingForNumber", "fusion:\n  rate_hz:\nlog:\n", R"(2:3: rate_hz must be a number in Hz; nothing stands here)"},
    {"ListForSection", "fusion: [1]", R"(1:9: fusion must be a map of "key: value" lines)"},
    {"MapForList", "targets: {name: a}", R"(1:10: targets must be a list, each item with "- " in front)"},
    {"TextForItem", "targets: [a]", R"(1:11: target must be a map of "key: value" lines)"},
    {"TwoCoordinates", "site: {anchors: [{name: A, address: 1, position_site_m: [1, 2]}]}",
     R"(1:57: position_site_m must be three numbers [x, y, z] in m; here stands a list)"},
    {"BadAddress", "targets: [{name: a, address: 0xZZ}]",
     R"(1:30: address must be an address (3, 0x1234 or DE:CA:...); here stands "0xZZ")"},
    {"NegativeAddress", "targets: [{name: a, address: -1}]",
     R"(1:30: address must be an address (3, 0x1234 or DE:CA:...); here stands "-1")"},
    // Out of range.
    {"TooLarge", "fusion: {rate_hz: 5000}", R"(1:19: rate_hz is 5000; it must be between 1 Hz and 1000 Hz)"},
    {"Negative", "realtime: {priority: -1}", R"(1:22: priority is -1; it must be between 0 and 98)"},
    {"CoordinateTooLarge", "site: {anchors: [{name: A, address: 1, position_site_m: [1, 2, 3e9]}]}",
     R"(1:64: position_site_m is 3e9; it must be between -100000 m and 100000 m)"},
    {"NoChoice", "log: {level: warn}", R"(1:14: level cannot be "warn"; known here: debug, info, warning, error, off)"},
    {"NearChoice", "log: {level: Warnin}", R"(1:14: level cannot be "Warnin"; did you mean "warning"?)"},
    {"AddressThatMeansNone", "targets: [{name: a, address: 0xFFFFFFFFFFFFFFFF}]",
     R"(1:30: address is the address that stands for "none"; no device has it)"},
    {"ResponderThatIsNone",
     "inputs: [{name: a, transport: serial, path: p, decoder: pulson_usb, tag: 18, responders: '101,x'}]",
     "1:10: input a: responders has 'x' where a node id such as 101 is due"},
    {"CanFilterThatIsNone", "inputs: [{name: a, transport: can, interface: can0, filter: 12, decoder: dw1000_can}]",
     "1:10: input a: the CAN filter '12' is not like 123, 200:7F0 or 18FF1234"},
    {"HalfARemoteAddress", "inputs: [{name: a, transport: udp, port: 1, remote_port: 2, decoder: pulson_udp, tag: 18}]",
     "1:10: input a: remote_address and remote_port go together"},
    {"SocketTooLong",
     "publish: {socket: /01234567890123456789012345678901234567890123456789012345678901234567890123456789"
     "01234567890123456789012345678}",
     "1:19: socket is longer than the 107 letters that the kernel takes"},
    {"MoreTargetsThanRoom", "fusion: {max_targets: 1}\ntargets: [{name: a, address: 1}, {name: b, address: 2}]",
     "2:10: 2 targets are listed, but fusion.max_targets is 1"},
    {"EstimatorWithoutOrigin", "site: {anchors: []}\nfusion: {estimator: gnss_ins}",
     "2:21: estimator gnss_ins needs site.origin: where on the Earth the site lies"},
    {"TargetWithoutOrigin", "site: {anchors: []}\ntargets: [{name: car, address: 1, estimator: gnss_ins}]",
     "2:46: estimator gnss_ins needs site.origin: where on the Earth the site lies"},
    {"ClockOfNoAnchor", "site: {anchors: [{name: a, address: 1, position_site_m: [0, 0, 0]}]}\nclock_sync: {master: 7}",
     "2:22: master is not the address of an anchor of the site"},
    // Missing.
    {"Missing", "targets:\n  - {name: a}",
     R"(2:5: target lacks "address": The number its tag calls itself by: 3, 0x1234, DE:CA:...)"},
    {"EmptyRequiredText", "targets: [{name: '', address: 1}]", "1:18: name is missing: the text is empty"},
    // Twice the same.
    {"DoubleKey", "log: {level: info,\n  level: debug}", R"(2:3: "level" stands here a second time; first in line 1)"},
    {"DoubleTargetName", "targets:\n  - {name: a, address: 1}\n  - {name: a, address: 2}",
     "3:5: a second target with the name a; the first is in line 2"},
    {"DoubleTargetAddress", "targets:\n  - {name: a, address: 17}\n  - {name: b, address: 0x11}",
     "3:5: a second target with the address 17; the first is in line 2"},
    {"DoubleAnchorName",
     "site:\n  anchors:\n    - {name: a, address: 1, position_site_m: [0, 0, 0]}\n"
     "    - {name: a, address: 2, position_site_m: [0, 0, 0]}",
     "4:7: a second anchor with the name a; the first is in line 3"},
    {"DoubleAnchorAddress",
     "site:\n  anchors:\n    - {name: a, address: 1, position_site_m: [0, 0, 0]}\n"
     "    - {name: b, address: 1, position_site_m: [0, 0, 0]}",
     "4:7: a second anchor with the address 1; the first is in line 3"},
    {"DoubleDevice",
     "inputs:\n  - {name: a, transport: serial, path: /dev/ttyUSB0, decoder: trek1000}\n"
     "  - {name: b, transport: serial, path: /dev/ttyUSB0, decoder: trek1000}",
     "3:40: a second input that reads /dev/ttyUSB0, which only one can; the first is in line 2"},
    {"DoubleDeviceByAnotherTransport",
     "inputs:\n  - {name: a, transport: serial, path: /dev/ttyUSB0, decoder: trek1000}\n"
     "  - {name: b, transport: pty, path: /dev/ttyUSB0, decoder: trek1000}",
     "3:37: a second input that reads /dev/ttyUSB0, which only one can; the first is in line 2"},
    // Names of things there are none of.
    {"UnknownKeyForDecoder", "inputs:\n  - {name: a, transport: fifo, path: /f,\n     decodr: trek1000, tag_offset: 3}",
     "2:5: input lacks \"decoder\": What it speaks: one of the decoders below.\n"
     "3:6: input has no setting \"decodr\"; did you mean \"decoder\"?"},
    {"UnknownKeyOfAnUnknownTransport",
     "inputs:\n  - {name: a, transport: seriel,\n     paht: /f, baud_bd: 9600, decoder: trek1000}",
     "2:26: there is no transport \"seriel\"; did you mean \"serial\"?\n"
     "3:6: input has no setting \"paht\"; did you mean \"path\"?"},
    {"UnknownTransport", "inputs: [{name: a, transport: seriel, decoder: trek1000, baud_bd: 9600}]",
     R"(1:31: there is no transport "seriel"; did you mean "serial"?)"},
    {"UnknownDecoder", "inputs: [{name: a, transport: fifo, path: /f, decoder: trek100}]",
     R"(1:56: there is no decoder "trek100"; did you mean "trek1000"?)"},
    {"UnknownEstimatorOfTarget", "targets: [{name: a, address: 1, estimator: range_efk}]",
     R"(1:44: there is no estimator "range_efk"; did you mean "range_ekf"?)"},
    {"UnknownEstimatorOfFusion", "fusion: {estimator: range_kf}",
     R"(1:21: there is no estimator "range_kf"; did you mean "range_ekf"?)"},
    {"InputOptionOfAnotherTransport", "inputs: [{name: a, transport: fifo, path: /f, decoder: trek1000, stop_bits: 1}]",
     R"(1:66: input has no setting "stop_bits"; known here: name, transport, decoder, delay_s, enabled, path, )"
     "anchor_offset, tag_offset"},
    {"InputNameOfTwoWords", "inputs: [{name: a b, transport: fifo, path: /f, decoder: trek1000}]",
     "1:17: name must be one word of at most 64 letters"},
    // Not YAML, or more than a settings file needs.
    {"Empty", "", "the file is empty; it needs at least a site with anchors and one input"},
    {"OnlyComments", "# nothing\n", "the file is empty; it needs at least a site with anchors and one input"},
    {"NotYaml", "site: {name: [}", "1:15: this is not YAML: illegal flow end"},
    {"NoMap", "just words", R"(1:1: the file must be a map of "key: value" lines)"},
    {"Include", "site: !include site.yaml", "1:7: tags such as !include are not understood; write the value out"},
    {"AliasBomb", "site: &a [x]\ntargets: [*a, *a]",
     "1:7: anchors (&name) are not understood here; write each value out"},
    {"ListAsKey", "{[a]: b}", "1:2: a key must be a plain word, not a list or a map"},
    {"TwoDocuments", "log: {}\n---\nlog: {}\n", "2:1: a second document begins here; a settings file is one document"},
    {"ControlCharacter", "log:\n  level: \x01",
     "2:10: this is not plain UTF-8 text; save the file as UTF-8 and take out characters that do not print"},
    {"EscapedControlCharacter", "site: {name: \"\\x07\"}", "1:14: name holds characters that do not print"},
};

class OneProblem : public testing::TestWithParam<Case> {};

TEST_P(OneProblem, IsToldWithItsPlace) { EXPECT_EQ(problem_of(GetParam().yaml), GetParam().problem); }

INSTANTIATE_TEST_SUITE_P(Load, OneProblem, testing::ValuesIn(cases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Problems, AllAreFoundInOneGoInTheOrderOfTheFile) {
    const auto problems =
        problems_of("log: {level: loud}\nfusion: {rate_hz: 0}\nsite: {anchors: [{name: A0}], nme: x}\n");
    ASSERT_EQ(problems.size(), 5u);
    EXPECT_TRUE(problems[0].starts_with("1:14: level cannot be"));
    EXPECT_TRUE(problems[1].starts_with("2:19: rate_hz is 0"));
    EXPECT_TRUE(problems[2].starts_with("3:18: anchor lacks \"address\""));
    EXPECT_TRUE(problems[3].starts_with("3:18: anchor lacks \"position_site_m\""));
    EXPECT_TRUE(problems[4].starts_with("3:31: site has no setting \"nme\""));
}

TEST(Problems, AFileThatIsWrongEverywhereIsNotRepeatedBackWhole) {
    std::string yaml = "targets:\n";
    for (int i = 0; i < 1000; ++i) yaml += "  - 1\n";
    const auto problems = problems_of(yaml);
    ASSERT_EQ(problems.size(), 101u);
    EXPECT_NE(problems.back().find("there are more problems"), std::string::npos);
}

} // namespace
} // namespace locus
