// SPDX-License-Identifier: MIT
#include "host/parameter.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "support/errors.hpp"

namespace hallway::host {
namespace {

hw_param_value_t real(double value) {
  hw_param_value_t result{};
  result.type = HW_PARAM_DOUBLE;
  result.as.real = value;
  return result;
}

hw_param_value_t whole(std::uint32_t type, std::int64_t value) {
  hw_param_value_t result{};
  result.type = type;
  result.as.integer = value;
  return result;
}

hw_param_info_t info_of(std::uint32_t type) {
  hw_param_info_t info{};
  info.size = sizeof info;
  info.type = type;
  info.name = "thing";
  info.unit = "";
  info.help = "";
  info.default_value = info.minimum = info.maximum = whole(type, 0);
  return info;
}

Parameter real_parameter() {
  hw_param_info_t info = info_of(HW_PARAM_DOUBLE);
  info.name = "noise_m";
  info.unit = "m";
  info.default_value = real(0.05);
  info.minimum = real(0.001);
  info.maximum = real(10);
  return read_parameter(&info);
}

Parameter whole_parameter() {
  hw_param_info_t info = info_of(HW_PARAM_INT);
  info.default_value = whole(HW_PARAM_INT, 20);
  info.minimum = whole(HW_PARAM_INT, -5);
  info.maximum = whole(HW_PARAM_INT, 100);
  return read_parameter(&info);
}

Parameter choice_parameter() {
  static constexpr const char* kChoices[] = {"fast", "exact"};
  hw_param_info_t info = info_of(HW_PARAM_CHOICE);
  info.choices = kChoices;
  info.n_choices = 2;
  return read_parameter(&info);
}

std::string problem_of(const std::function<void()>& work, ErrorCode code) {
  const auto error = test::error_of(work);
  if (!error) return "";
  EXPECT_EQ(error->code(), code);
  return error->what();
}

std::string parse_problem(const Parameter& parameter, std::string_view text) {
  return problem_of([&] { parameter.parse(text); }, ErrorCode::kBadInput);
}

std::string read_problem(const hw_param_info_t& info) {
  return problem_of([&] { read_parameter(&info); }, ErrorCode::kPluginLoad);
}

TEST(Parameter, ANumberIsReadAndPrinted) {
  const Parameter parameter = real_parameter();
  EXPECT_EQ(parameter.type_name(), "double");
  EXPECT_EQ(parameter.parse("0.25").as.real, 0.25);
  EXPECT_EQ(parameter.print(parameter.parse("1e-2")), "0.01");
}

TEST(Parameter, TheEndsOfTheRangeAreAllowed) {
  EXPECT_EQ(real_parameter().parse("0.001").as.real, 0.001);
  EXPECT_EQ(real_parameter().parse("10").as.real, 10);
}

TEST(Parameter, ANumberOutsideOfItsRangeIsRefusedWithTheRange) {
  EXPECT_NE(parse_problem(real_parameter(), "20").find("`20` is not a number from 0.001 to 10 m"),
            std::string::npos);
  EXPECT_NE(parse_problem(whole_parameter(), "-6").find("`-6` is not a whole number from -5 to 100"),
            std::string::npos);
}

TEST(Parameter, WhatIsNoNumberIsRefused) {
  for (const char* text : {"", "abc", "nan", "inf", "1e999", "0x10", "1 ", "1,5"}) {
    EXPECT_NE(parse_problem(real_parameter(), text), "") << text;
  }
  for (const char* text : {"", "1.5", "99999999999999999999", "1e2"}) {
    EXPECT_NE(parse_problem(whole_parameter(), text), "") << text;
  }
}

TEST(Parameter, ASwitchIsTrueOrFalse) {
  const hw_param_info_t info = info_of(HW_PARAM_BOOL);
  const Parameter parameter = read_parameter(&info);
  EXPECT_EQ(parameter.parse("true").as.integer, 1);
  EXPECT_EQ(parameter.print(parameter.parse("false")), "false");
  EXPECT_NE(parse_problem(parameter, "yes").find("true or false"), std::string::npos);
}

TEST(Parameter, AChoiceIsOneOfItsNames) {
  EXPECT_EQ(choice_parameter().parse("exact").as.integer, 1);
  EXPECT_EQ(choice_parameter().print(choice_parameter().parse("exact")), "exact");
}

TEST(Parameter, AnUnknownChoiceIsRefusedWithASuggestion) {
  const std::string problem = parse_problem(choice_parameter(), "exakt");
  EXPECT_NE(problem.find("one of fast, exact (did you mean "), std::string::npos) << problem;
}

TEST(Parameter, AValueIsNotEchoedRaw) {
  EXPECT_EQ(parse_problem(real_parameter(), "\033[31m").find('\033'), std::string::npos);
}

TEST(Parameter, OneOfAnUnknownTypeIsKeptButNotSettable) {
  const hw_param_info_t info = info_of(99);
  const Parameter parameter = read_parameter(&info);
  EXPECT_EQ(parameter.type_name(), "type 99");
  EXPECT_NE(parse_problem(parameter, "1"), "");
}

TEST(Parameter, ADefaultOutsideOfItsRangeIsRefused) {
  hw_param_info_t info = info_of(HW_PARAM_INT);
  info.default_value = whole(HW_PARAM_INT, 3);
  EXPECT_NE(read_problem(info).find("parameter `thing`: declares a parameter badly: its default is outside"),
            std::string::npos)
      << read_problem(info);
}

TEST(Parameter, ADefaultThatIsNotFiniteIsRefused) {
  hw_param_info_t info = info_of(HW_PARAM_DOUBLE);
  info.default_value = real(std::numeric_limits<double>::quiet_NaN());
  info.minimum = real(-std::numeric_limits<double>::infinity());
  info.maximum = real(std::numeric_limits<double>::infinity());
  EXPECT_NE(read_problem(info).find("not finite"), std::string::npos);
}

TEST(Parameter, AChoiceWithoutChoicesIsRefused) {
  EXPECT_NE(read_problem(info_of(HW_PARAM_CHOICE)).find("choices"), std::string::npos);
}

TEST(Parameter, ANullNameIsRefused) {
  hw_param_info_t info = info_of(HW_PARAM_INT);
  info.name = nullptr;
  EXPECT_NE(read_problem(info).find("its name is null"), std::string::npos);
}

}  // namespace
}  // namespace hallway::host
