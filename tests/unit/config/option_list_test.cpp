// Lists of maps inside an input: what a layout's fields are written as.
#include "load_fixture.h"

#include "drivers/layout/can_layout.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus {
namespace {

const std::string car = R"(site: {name: yard}
inputs:
  - name: car
    transport: can
    interface: can0
    decoder: can_layout
    tag: 5
    fields:
      - {quantity: wheel_speed, can_id: 0xB2, start_bit: 0, length_bits: 16, factor: 0.0075, unit: km/h}
      - {quantity: yaw_rate, can_id: 0x70, start_bit: 0, length_bits: 16, factor: 0.005, offset: -163.84, unit: deg/s}
)";

TEST(OptionList, IsReadItemByItem) {
    const auto result = load_settings_text(car, "f");
    ASSERT_TRUE(result.settings) << problem_of(car);
    const auto& layout =
        *static_cast<const layout::CanLayoutSettings*>(result.settings->inputs.at(0).decoder_settings.get());
    ASSERT_EQ(layout.fields.size(), 2u);
    EXPECT_EQ(layout.fields[0].can_id, 0xB2u);
    EXPECT_EQ(layout.fields[1].offset, -163.84);
    EXPECT_TRUE(std::isnan(layout.fields[1].invalid_raw));
}

TEST(OptionList, PrintsWhatLoadsToTheSame) {
    const auto first = load_settings_text(car, "f");
    ASSERT_TRUE(first.settings);
    const std::string printed = print_settings(*first.settings);
    const auto again = load_settings_text(printed, "printed");
    ASSERT_TRUE(again.settings) << to_string(again.problems.front()) << "\n" << printed;
    EXPECT_EQ(print_settings(*again.settings), printed);
    EXPECT_NE(printed.find("- {quantity: \"yaw_rate\", can_id: 112"), std::string::npos) << printed;
}

std::string with_field(const std::string& field) { return car + "      - {" + field + "}\n"; }

TEST(OptionList, ItsItemsHaveTheUsualErrors) {
    EXPECT_EQ(problem_of(with_field("quantity: wheel_sped, can_id: 1, start_bit: 0, length_bits: 8")),
              "11:20: quantity cannot be \"wheel_sped\"; did you mean \"wheel_speed\"?");
    EXPECT_EQ(problem_of(with_field("quantity: range, can_id: 1, start_bit: 0, length_bits: 99, unit: m")),
              "11:65: length_bits is 99; it must be between 1 and 64");
    EXPECT_EQ(problem_of(with_field("quantity: range, can_id: 1, start_bit: 0, lenght_bits: 9")),
              "11:9: an item of fields lacks \"length_bits\": Bits it has.\n"
              "11:52: an item of fields has no setting \"lenght_bits\"; did you mean \"length_bits\"?");
}

TEST(OptionList, WhatDoesNotFitTogetherIsToldOfTheInput) {
    EXPECT_EQ(problem_of(with_field("quantity: range, can_id: 1, start_bit: 0, length_bits: 8, unit: km/h")),
              "3:5: input car: item 3 of fields (range): range cannot have the unit km/h; it can have m, cm, mm");
}

} // namespace
} // namespace locus
