// SPDX-License-Identifier: MIT
// Parameters that are texts, files and folders, in this process and in one of the plugin's own.
#include "host/text_parameter.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "base/file.hpp"
#include "fixtures.hpp"
#include "host/isolate/isolated_plugin.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;
using test_fixtures::frame_of;
using test_fixtures::point_sensors;

const std::string kPlugin = FIXTURES "/reads_paths.so";

class TextParameters : public testing::TestWithParam<bool> {
 protected:
  TextParameters() : plugin_(make()) { write_file_atomically(path("model.bin"), "12345"); }

  static std::unique_ptr<Stage> make() {
    if (GetParam())
      return std::make_unique<IsolatedPlugin>(kPlugin, std::span<const fs::path>{}, Isolation{});
    return std::make_unique<Plugin>(find_plugin(kPlugin, {}));
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  /// Where a setting in a file of this folder was written.
  Where in_file() const { return {path("scenario.toml").string(), 3, ""}; }
  void set(const std::string& name, const std::string& value) {
    plugin_->set_parameter(name, value, in_file());
  }
  std::string text(const std::string& name) {
    for (std::size_t i = 0; i < plugin_->parameters().size(); ++i) {
      if (plugin_->parameters()[i].name == name) return plugin_->parameter_text(i);
    }
    return "no such parameter";
  }
  std::map<std::string, double> counters_of_a_frame() {
    plugin_->activate(point_sensors());
    FrameBuilder builder;
    std::map<std::string, double> counters;
    for (const Counter& counter : plugin_->process(frame_of(builder, 0, {})).counters())
      counters[counter.name] = counter.value;
    return counters;
  }
  void expect_refused(const std::string& name, const std::string& value, const std::string& reason) {
    const std::string before = text(name);
    const auto error = test::error_of([&] { set(name, value); });
    ASSERT_TRUE(error) << name;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_EQ(error->where().line, 3);
    EXPECT_NE(error->message().find(name), std::string::npos) << error->what();
    EXPECT_NE(error->message().find(reason), std::string::npos) << error->what();
    EXPECT_EQ(text(name), before);
  }

  test::TempFolder folder_;
  std::unique_ptr<Stage> plugin_;
};

TEST_P(TextParameters, AreDescribedWithTheirKinds) {
  std::map<std::string, std::string> types;
  std::map<std::string, bool> writable;
  for (const Parameter& parameter : plugin_->parameters()) {
    types[parameter.name] = parameter.type_name();
    writable[parameter.name] = parameter.writable;
  }
  EXPECT_EQ(types, (std::map<std::string, std::string>{{"noise_m", "double"},
                                                       {"label", "text"},
                                                       {"model", "file"},
                                                       {"store", "folder"},
                                                       {"journal", "file"}}));
  EXPECT_FALSE(writable["model"]);
  EXPECT_TRUE(writable["store"]);
  EXPECT_TRUE(writable["journal"]);
  EXPECT_EQ(plugin_->parameters()[1].default_value_text(), "none");
}

TEST_P(TextParameters, ATextArrivesAsItIs) {
  EXPECT_EQ(text("label"), "none");
  set("label", "größer 1.50");
  EXPECT_EQ(text("label"), "größer 1.50");
  EXPECT_EQ(counters_of_a_frame().at("label_bytes"), 13);
}

TEST_P(TextParameters, ARelativePathIsRelativeToTheFileThatSetsIt) {
  set("model", "model.bin");
  EXPECT_EQ(text("model"), path("model.bin").string());
  EXPECT_EQ(counters_of_a_frame().at("file_bytes"), 5);
}

TEST_P(TextParameters, OnTheCommandLineAPathIsRelativeToTheWorkingFolder) {
  const fs::path relative = fs::relative(path("model.bin"));
  plugin_->set_parameter("model", relative.string(), {.file = "command line", .line = 0, .element = ""});
  EXPECT_EQ(counters_of_a_frame().at("file_bytes"), 5);
}

TEST_P(TextParameters, WhatIsDeclaredWritableCanBeWritten) {
  set("model", "model.bin");
  set("store", "made_here");
  set("label", "kept");
  set("journal", "journal.txt");
  auto counters = counters_of_a_frame();
  EXPECT_EQ(counters.at("wrote_folder"), 1);
  EXPECT_EQ(counters.at("wrote_file"), 1);
  EXPECT_EQ(counters.at("file_bytes"), 5) << "what was set before is kept";
  EXPECT_EQ(counters.at("label_bytes"), 4);
  EXPECT_EQ(read_file(path("made_here") / "made"), "written");
  EXPECT_EQ(read_file(path("journal.txt")), "written");
}

TEST_P(TextParameters, AnIsolatedPluginWritesNowhereElse) {
  if (!GetParam()) GTEST_SKIP() << "in this process nothing keeps it from that";
  set("model", "model.bin");
  set("store", "made_here");
  EXPECT_EQ(counters_of_a_frame().at("wrote_elsewhere"), 0);
  EXPECT_FALSE(fs::exists(path("beside")));
}

TEST_P(TextParameters, WhatStandsInAFileThatIsWrittenIsNotLostBefore) {
  write_file_atomically(path("journal.txt"), "old");
  set("journal", "journal.txt");
  EXPECT_EQ(read_file(path("journal.txt")), "old");
}

TEST_P(TextParameters, PathsThatCannotBeAreRefused) {
  expect_refused("model", "missing.bin", "there is no such file");
  expect_refused("model", ".", "is a folder");
  expect_refused("store", "model.bin", "is no folder");
  expect_refused("label", std::string(5000, 'x'), "5000 bytes");
  const auto error = test::error_of([&] { set("store", "missing/made"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo) << error->what();
}

TEST_P(TextParameters, AnEmptyPathIsNone) {
  set("model", "model.bin");
  set("model", "");
  EXPECT_EQ(text("model"), "");
  EXPECT_EQ(counters_of_a_frame().at("file_bytes"), 0);
}

TEST_P(TextParameters, ThePluginMayRefuseAText) {
  set("label", "refused");
  const auto error = test::error_of([&] { plugin_->activate(point_sensors()); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(error->message().find("it shall not be called so"), std::string::npos) << error->what();
}

INSTANTIATE_TEST_SUITE_P(Plugins, TextParameters, testing::Values(false, true),
                         [](const auto& instance) { return instance.param ? "Isolated" : "InProcess"; });

}  // namespace
}  // namespace hallway::host
