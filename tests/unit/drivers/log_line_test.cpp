// Recording lines: candump's format read and written, ours beside it, and every way a line can be wrong.
#include "drivers/recording/log_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace locus {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

LogRecord parse(std::string_view line) {
    std::string error;
    const auto record = from_log_line(line, error);
    EXPECT_TRUE(record) << line << ": " << error;
    return record.value_or(LogRecord{});
}

std::string error_of(std::string_view line) {
    std::string error;
    EXPECT_FALSE(from_log_line(line, error)) << line;
    return error;
}

TEST(LogLine, StandardFrame) {
    const LogRecord record = parse("(1698765432.123456) can0 0AA#28812881287D2885");
    EXPECT_EQ(to_ns(record.time), 1698765432123456000);
    EXPECT_EQ(record.input, "can0");
    EXPECT_EQ(record.wire, Wire::can);
    EXPECT_EQ(record.can_id, 0xAAu);
    EXPECT_EQ(record.data, (Bytes{0x28, 0x81, 0x28, 0x81, 0x28, 0x7D, 0x28, 0x85}));
}

TEST(LogLine, TheNumberOfDigitsIsTheKindOfTheId) {
    EXPECT_EQ(parse("(1.0) can0 10EBFF80#01").can_id, 0x10EBFF80u | CAN_EFF_FLAG);
    EXPECT_EQ(parse("(1.0) can0 00000123#01").can_id, 0x123u | CAN_EFF_FLAG);
    EXPECT_EQ(parse("(1.0) can0 20000004#0008000000000000").can_id, 0x20000004u) << "error frame";
}

TEST(LogLine, RemoteFramesAndLongLengthCodes) {
    EXPECT_EQ(parse("(1.0) can0 7DF#R8").can_id, 0x7DFu | CAN_RTR_FLAG);
    EXPECT_TRUE(parse("(1.0) can0 7DF#R8").data.empty());
    EXPECT_EQ(parse("(1.0) can0 7DF#R").can_id, 0x7DFu | CAN_RTR_FLAG);
    EXPECT_EQ(parse("(1.0) can0 123#1122334455667788_F").data.size(), 8u);
}

TEST(LogLine, FdFrame) {
    const LogRecord record = parse("(1698765432.126000) can0 123##311223344556677889900AABB");
    EXPECT_TRUE(record.can_fd);
    EXPECT_EQ(record.can_fd_flags, 3);
    EXPECT_EQ(record.data.size(), 12u);
    EXPECT_TRUE(parse("(1.0) can0 123##0").can_fd);
}

TEST(LogLine, SerialChunkAndDirectionAndLineEnds) {
    const LogRecord record = parse("(12.000000345) hall serial#6D630D0A\r");
    EXPECT_EQ(to_ns(record.time), 12'000'000'345);
    EXPECT_EQ(record.wire, Wire::bytes);
    EXPECT_EQ(record.data, (Bytes{'m', 'c', '\r', '\n'}));
    EXPECT_EQ(parse("(12.0) hall serial#6D 86806").byte_time, Duration{86806});
    EXPECT_EQ(parse("(1.000001) vcan0 123#11 T").data, Bytes{0x11});
    EXPECT_EQ(parse("(1.000001)  vcan0  123#11  R\n").data, Bytes{0x11});
}

TEST(LogLine, BlankLinesAndCommentsAreNoErrors) {
    for (const std::string_view line : {"", "  \r", "# made by hand"}) EXPECT_EQ(error_of(line), "") << line;
}

TEST(LogLine, SaysWhatIsWrong) {
    EXPECT_THAT(error_of("DROPCOUNT: dropped 3 CAN frames"), HasSubstr("time"));
    EXPECT_THAT(error_of("(now) can0 123#11"), HasSubstr("time"));
    EXPECT_THAT(error_of("(-1.0) can0 123#11"), HasSubstr("time"));
    EXPECT_THAT(error_of("(1.0) can0"), HasSubstr("id"));
    EXPECT_THAT(error_of("(1.0) can0 1234#11"), HasSubstr("id"));
    EXPECT_THAT(error_of("(1.0) can0 8FF#11"), HasSubstr("id"));
    EXPECT_THAT(error_of("(1.0) can0 40000000#11"), HasSubstr("id"));
    EXPECT_THAT(error_of("(1.0) can0 123#1"), HasSubstr("odd"));
    EXPECT_THAT(error_of("(1.0) can0 123#1G"), HasSubstr("hex"));
    EXPECT_THAT(error_of("(1.0) can0 123#112233445566778899"), HasSubstr("more than 8"));
    EXPECT_THAT(error_of("(1.0) can0 123##"), HasSubstr("flags"));
    EXPECT_THAT(error_of("(1.0) can0 123##0" + std::string(130, '0')), HasSubstr("more than 64"));
    EXPECT_THAT(error_of("(1.0) can0 123#R9"), HasSubstr("#R"));
    EXPECT_THAT(error_of("(1.0) can0 123#11_9"), HasSubstr("length code"));
    EXPECT_THAT(error_of("(1.0) can0 123#1122334455667788_8"), HasSubstr("length code"));
    EXPECT_THAT(error_of("(1.0) can0 123#11 X"), HasSubstr("after the data"));
    EXPECT_THAT(error_of("(1.0) hall serial#11 T"), HasSubstr("after the data"));
    EXPECT_THAT(error_of("(1.0) hall serial#11 5000000000"), HasSubstr("after the data"));
    EXPECT_THAT(error_of("(1.0) hall serial#" + std::string(8194, '0')), HasSubstr("more than 4096"));
}

/// Frames as the wire can hold them; stamps as the transports give them.
LogRecord any_record() {
    LogRecord record;
    record.input = "in" + std::to_string(*rc::gen::inRange(0, 99));
    const bool can = *rc::gen::arbitrary<bool>();
    record.time = timestamp_from_ns(*rc::gen::inRange<std::int64_t>(0, 8'999'999'999'000'000) * 1000);
    std::size_t longest = 4096;
    if (!can) record.byte_time = Duration{*rc::gen::arbitrary<std::uint32_t>()};
    if (can) {
        record.wire = Wire::can;
        const bool extended = *rc::gen::arbitrary<bool>();
        record.can_id =
            extended ? *rc::gen::inRange(0u, CAN_EFF_MASK + 1) | CAN_EFF_FLAG : *rc::gen::inRange(0u, CAN_SFF_MASK + 1);
        record.can_fd = *rc::gen::arbitrary<bool>();
        if (record.can_fd) record.can_fd_flags = *rc::gen::inRange<std::uint8_t>(0, 16);
        longest = record.can_fd ? 64 : 8;
    }
    record.data = *rc::gen::resize(int(longest), rc::gen::arbitrary<Bytes>());
    if (record.data.size() > longest) record.data.resize(longest);
    if (can && !record.can_fd && *rc::gen::inRange(0, 4) == 0) {
        record.can_id |= CAN_RTR_FLAG;
        record.data.clear();
    }
    return record;
}

RC_GTEST_PROP(LogLineProperty, WhatIsWrittenIsReadBack, ()) {
    const LogRecord record = any_record();
    std::string error;
    const auto back = from_log_line(to_log_line(record.input, record.packet()), error);
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->time == record.time);
    RC_ASSERT(back->input == record.input);
    RC_ASSERT(back->wire == record.wire);
    RC_ASSERT(back->byte_time == record.byte_time);
    RC_ASSERT(back->can_id == record.can_id);
    RC_ASSERT(back->can_fd == record.can_fd);
    RC_ASSERT(back->can_fd_flags == record.can_fd_flags);
    RC_ASSERT(back->data == record.data);
}

TEST(LogLine, IsWrittenAsCandumpWritesIt) {
    for (const std::string line :
         {"(1698765432.123456) can0 0AA#28812881287D2885", "(1698765432.124001) can0 10EBFF80#0102010007000000",
          "(1698765432.125000) can0 7DF#R", "(1698765432.126000) can0 123##311223344556677889900AABB",
          "(1698765432.127000) can0 20000004#0008000000000000", "(12.000345) hall serial#6D630D0A",
          "(12.000345) hall serial#6D630D0A 86806"}) {
        const LogRecord record = parse(line);
        EXPECT_EQ(to_log_line(record.input, record.packet()), line);
    }
}

} // namespace
} // namespace locus
