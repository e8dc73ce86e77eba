// SPDX-License-Identifier: MIT
#include "host/load/plugin_info.hpp"

#include <gtest/gtest.h>
#include <hallway/output.h>
#include <hallway/sample.h>

#include "host/output/output_kind.hpp"
#include "host/samples/sample_kind.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

constexpr std::uint32_t kKinds[] = {HW_SAMPLE_POINTS, 77};

hw_plugin_info_t good_info() {
  hw_plugin_info_t info{};
  info.size = sizeof info;
  info.id = "a.b-c_1";
  info.name = "Name";
  info.version = "1";
  info.vendor = "";
  info.description = "";
  info.inputs = kKinds;
  info.n_inputs = 2;
  return info;
}

std::string problem_of(const hw_plugin_info_t& info) {
  const auto error = test::error_of([&] { read_plugin_info(&info); });
  return error ? error->message() : "";
}

TEST(PluginInfo, IsCopied) {
  const hw_plugin_info_t info = good_info();
  const PluginInfo copy = read_plugin_info(&info);
  EXPECT_EQ(copy.id, "a.b-c_1");
  EXPECT_EQ(copy.name, "Name");
  EXPECT_EQ(copy.inputs, std::vector<std::uint32_t>({HW_SAMPLE_POINTS, 77}));
  EXPECT_TRUE(copy.outputs.empty());
}

TEST(PluginInfo, HasOptionalInputsSinceVersion14) {
  static constexpr std::uint32_t kOptional[] = {HW_SAMPLE_PLANES};
  hw_plugin_info_t info = good_info();
  info.optional_inputs = kOptional;
  info.n_optional_inputs = 1;
  const PluginInfo copy = read_plugin_info(&info);
  EXPECT_EQ(copy.optional_inputs, std::vector<std::uint32_t>{HW_SAMPLE_PLANES});
  EXPECT_TRUE(copy.takes(HW_SAMPLE_POINTS));
  EXPECT_TRUE(copy.takes(HW_SAMPLE_PLANES));
  EXPECT_FALSE(copy.takes(HW_SAMPLE_IMAGE));
  // What an older plugin's struct does not have is not read.
  info.size = offsetof(hw_plugin_info_t, optional_inputs);
  EXPECT_TRUE(read_plugin_info(&info).optional_inputs.empty());
  info.size = sizeof info;
  info.optional_inputs = nullptr;
  EXPECT_NE(problem_of(info).find("optional inputs are null"), std::string::npos);
}

TEST(PluginInfo, TextsAreMadeSafeToPrint) {
  hw_plugin_info_t info = good_info();
  info.description = "red \033[31m and \xff";
  const std::string text = read_plugin_info(&info).description;
  EXPECT_EQ(text.find('\033'), std::string::npos);
  EXPECT_EQ(text.find('\xff'), std::string::npos);
}

TEST(PluginInfo, AStructThatIsTooSmallIsRefused) {
  hw_plugin_info_t info = good_info();
  info.size = 16;
  EXPECT_NE(problem_of(info).find("size of 16 bytes"), std::string::npos);
}

TEST(PluginInfo, AnEmptyIdIsRefused) {
  hw_plugin_info_t info = good_info();
  info.id = "";
  EXPECT_NE(problem_of(info).find("its id"), std::string::npos);
}

TEST(PluginInfo, AWildNumberOfKindsIsRefused) {
  hw_plugin_info_t info = good_info();
  info.n_inputs = 0x7fffffff;
  EXPECT_NE(problem_of(info).find("2147483647 inputs"), std::string::npos);
}

TEST(PluginInfo, KindsHaveNames) {
  EXPECT_EQ(sample_kind_name(HW_SAMPLE_POINTS), "points");
  EXPECT_EQ(sample_kind_name(HW_SAMPLE_DEPTH), "depth");
  EXPECT_EQ(sample_kind_name(77), "kind 77");
  EXPECT_EQ(sample_kind_name(0), "kind 0");
  EXPECT_EQ(output_kind_name(HW_OUTPUT_DRAWING), "drawing");
}

}  // namespace
}  // namespace hallway::host
