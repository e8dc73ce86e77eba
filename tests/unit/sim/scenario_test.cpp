// SPDX-License-Identifier: MIT
#include "sim/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;

Scenario load(const std::string& text) {
  const test::TempFolder folder;
  return load_scenario(folder.write("s.toml", text));
}

/// "value from origin" of a setting.
std::string setting(const Scenario& scenario, const std::string& key) {
  const auto found = std::find_if(scenario.settings.begin(), scenario.settings.end(),
                                  [&](const Setting& entry) { return entry.key == key; });
  return found == scenario.settings.end() ? "none" : found->value + " from " + found->origin;
}

TEST(LoadScenario, ReadsWhatTheFileSays) {
  const Scenario scenario = load(test::scenario_text());
  EXPECT_EQ(scenario.seed, 5u);
  EXPECT_EQ(scenario.steps, 40u);
  EXPECT_EQ(scenario.period_ns, 100'000'000);
  EXPECT_EQ(scenario.period_s(), 0.1);
  EXPECT_EQ(scenario.robot.path, "round");
  EXPECT_EQ(scenario.robot.loop_steps, 20u);
  EXPECT_FALSE(scenario.robot.speed_m_s.has_value());
}

TEST(LoadScenario, HasLimitsForPlugins) {
  const Scenario usual = load(test::scenario_text());
  EXPECT_EQ(usual.limits.call_timeout_s, 60.0);
  EXPECT_EQ(usual.limits.memory_mib, 4096u);
  EXPECT_EQ(usual.limits.on_failure, OnFailure::kStop);
  const Scenario own =
      load("call_timeout_s = 0.5\nmemory_limit_mib = 100\non_failure = 'restart'\n" + test::scenario_text());
  EXPECT_EQ(own.limits.call_timeout_s, 0.5);
  EXPECT_EQ(own.limits.memory_mib, 100u);
  EXPECT_EQ(own.limits.on_failure, OnFailure::kRestart);
}

TEST(LoadScenario, LooksForTheMapBesideTheScenario) {
  const test::TempFolder folder;
  const auto file = folder.write("s.toml", test::scenario_text());
  EXPECT_EQ(load_scenario(file).map_file, folder / "small.map");
  EXPECT_EQ(load_scenario(file).file, file.string());
}

TEST(LoadScenario, InTheFolderOfARunTheMapIsItsCopy) {
  const test::TempFolder folder;
  const auto file = folder.write("scenario.toml", test::scenario_text());
  EXPECT_EQ(load_scenario(file).map_file, folder / "small.map") << "there is no copy";
  folder.write("map.map", "");
  EXPECT_EQ(load_scenario(file).map_file, folder / "map.map");
  EXPECT_EQ(load_scenario(folder.write("s.toml", test::scenario_text())).map_file, folder / "small.map");
  folder.write("small.map", "");
  EXPECT_EQ(load_scenario(file).map_file, folder / "small.map") << "the map that is named comes first";
}

TEST(LoadScenario, TakesDefaults) {
  const Scenario scenario =
      load("map = 'a'\nsteps = 3\n[robot]\npath = 'p'\nspeed_m_s = 2\n[sensor.eyes]\nkind = 'points'\n");
  EXPECT_EQ(scenario.seed, 1u);
  EXPECT_EQ(scenario.period_ns, 100'000'000);
  ASSERT_EQ(scenario.sensors.size(), 1u);
  const auto& eyes = std::get<sense::PointSensorSpec>(scenario.sensors[0]);
  EXPECT_EQ(eyes.name, "eyes");
  EXPECT_DOUBLE_EQ(eyes.horizontal_fov, kPi / 2);
  EXPECT_DOUBLE_EQ(eyes.vertical_fov, kPi / 3);
  EXPECT_EQ(eyes.min_range_m, 0.0);
  EXPECT_EQ(eyes.max_range_m, 100.0);
  EXPECT_EQ(eyes.noise_m, Vec3::Zero());
  EXPECT_EQ(eyes.T_body_sensor.t, Vec3::Zero());
  EXPECT_EQ(eyes.T_body_sensor.q.coeffs(), Quat::Identity().coeffs());
  EXPECT_TRUE(scenario.pipeline.empty());
  EXPECT_TRUE(scenario.pictures.empty());
}

TEST(LoadScenario, ReadsASensor) {
  const Scenario scenario = load(test::scenario_text(
      "[sensor.left-eye]\nkind = 'points'\nhorizontal_fov_deg = 360\n"
      "vertical_fov_deg = 30\nmin_range_m = 1\nmax_range_m = 2.5\n"
      "noise_m = [0.1, 0.2, 0]\nnoise_per_m = [0, 0.01, 1]\nposition_m = [1, -2, 3.5]\nyaw_deg = 90\n"));
  const auto& eye = std::get<sense::PointSensorSpec>(scenario.sensors.at(0));
  EXPECT_DOUBLE_EQ(eye.horizontal_fov, 2 * kPi);
  EXPECT_DOUBLE_EQ(eye.vertical_fov, kPi / 6);
  EXPECT_EQ(eye.min_range_m, 1.0);
  EXPECT_EQ(eye.max_range_m, 2.5);
  EXPECT_EQ(eye.noise_m, Vec3(0.1, 0.2, 0.0));
  EXPECT_EQ(eye.noise_per_m, Vec3(0.0, 0.01, 1.0));
  EXPECT_EQ(eye.T_body_sensor.t, Vec3(1, -2, 3.5));
  EXPECT_LT((eye.T_body_sensor.q * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
}

TEST(LoadScenario, TakesOneNoiseForAllAxes) {
  const Scenario one = load(test::scenario_text("[sensor.a]\nkind = 'points'\nnoise_m = 0.05\n"));
  EXPECT_EQ(std::get<sense::PointSensorSpec>(one.sensors.at(0)).noise_m, Vec3::Constant(0.05));
}

TEST(LoadScenario, KeepsTheSensorsInTheOrderOfTheFile) {
  const Scenario scenario =
      load(test::scenario_text("[sensor.z]\nkind = 'points'\n[sensor.a]\nkind = 'points'\n"));
  ASSERT_EQ(scenario.sensors.size(), 2u);
  EXPECT_EQ(std::get<sense::PointSensorSpec>(scenario.sensors[0]).name, "z");
  EXPECT_EQ(std::get<sense::PointSensorSpec>(scenario.sensors[1]).name, "a");
}

TEST(LoadScenario, ReadsThePipeline) {
  const Scenario scenario =
      load(test::scenario_text("[[plugin]]\nname = 'em'\n[[plugin]]\nname = 'slam'\nparams = {b = 0.5, a = "
                               "3, on = true, mode = 'x y'}\n"));
  ASSERT_EQ(scenario.pipeline.size(), 2u);
  EXPECT_EQ(scenario.pipeline[0].plugin, "em");
  const auto& params = scenario.pipeline[1].parameters;
  ASSERT_EQ(params.size(), 4u);
  EXPECT_EQ(params[0].name + "=" + params[0].value, "b=0.5");
  EXPECT_EQ(params[1].name + "=" + params[1].value, "a=3");
  EXPECT_EQ(params[2].name + "=" + params[2].value, "on=true");
  EXPECT_EQ(params[3].name + "=" + params[3].value, "mode=x y");
  EXPECT_EQ(params[0].where.line, 12);
}

TEST(LoadScenario, LooksForAPluginFileBesideTheScenario) {
  const test::TempFolder folder;
  const auto file = folder.write("s.toml", test::scenario_text("[[plugin]]\nname = 'sub/slam.so'\n"));
  EXPECT_EQ(load_scenario(file).pipeline.at(0).plugin, (folder / "sub/slam.so").string());
}

TEST(ShortPluginName, IsThatOfThePluginInTheFile) {
  EXPECT_EQ(short_plugin_name("slam_point"), "slam_point");
  EXPECT_EQ(short_plugin_name("./x/slam_point.so"), "slam_point");
  EXPECT_EQ(short_plugin_name("slam_point.so"), "slam_point");
  EXPECT_EQ(short_plugin_name("/x/many.so:one"), "one");
}

TEST(LoadScenario, ReadsAPicture) {
  const Scenario scenario =
      load(test::scenario_text("[[picture]]\nfile = 'a.png'\nview = 'perspective'\nwidth_px = 640\n"
                               "height_px = 480\ncut_z_m = 1.5\neye_m = [1, 2, 3]\n"
                               "target_m = [0, 0, 0]\nshow = ['truth', 'map']\n"));
  const PictureSpec& picture = scenario.pictures.at(0);
  EXPECT_EQ(picture.file, "a.png");
  EXPECT_EQ(picture.view, PictureView::kPerspective);
  EXPECT_EQ(picture.width_px, 640);
  EXPECT_EQ(picture.height_px, 480);
  EXPECT_EQ(picture.cut_z_m, 1.5);
  EXPECT_EQ(picture.eye_m, Vec3(1, 2, 3));
  EXPECT_EQ(picture.target_m, Vec3(0, 0, 0));
  EXPECT_TRUE(picture.shows(PictureLayer::kMap));
  EXPECT_TRUE(picture.shows(PictureLayer::kTruth));
  EXPECT_FALSE(picture.shows(PictureLayer::kErrors));
}

TEST(ScenarioPictures, MayBeOfIterations) {
  const Scenario scenario =
      load(test::scenario_text("[[picture]]\nfile = 'a.png'\niteration = 0\n"
                               "[[picture]]\nfile = 'b.x.png'\nview = 'camera'\nevery = 7\n"));
  EXPECT_EQ(scenario.pictures.at(0).iteration, 0u);
  const PictureSpec& many = scenario.pictures.at(1);
  EXPECT_EQ(many.view, PictureView::kCamera);
  EXPECT_EQ(many.every, 7u);
  EXPECT_FALSE(many.iteration);
  EXPECT_EQ(many.at(120).file, "b.x_000120.png");
  EXPECT_EQ(many.at(120).iteration, 120u);
  EXPECT_EQ(many.at(120).every, 0u);
  EXPECT_EQ(many.at(12'345'678).file, "b.x_12345678.png");
}

TEST(LoadScenario, APictureShowsTheUsualLayersUnlessToldOtherwise) {
  const PictureSpec picture = load(test::scenario_text("[[picture]]\nfile = 'a.png'\n")).pictures.at(0);
  EXPECT_EQ(picture.view, PictureView::kTop);
  EXPECT_EQ(picture.show.size(), picture_layer_names().size() - 2);
  EXPECT_FALSE(picture.iteration);
  EXPECT_EQ(picture.every, 0u);
  EXPECT_TRUE(picture.shows(PictureLayer::kFrustum));
  EXPECT_FALSE(picture.shows(PictureLayer::kSubmaps));
  EXPECT_FALSE(picture.shows(PictureLayer::kDeskewed));
  EXPECT_TRUE(picture.shows(PictureLayer::kTopology));
  EXPECT_TRUE(picture.shows(PictureLayer::kDrawing));
}

TEST(LoadScenario, TakesItsSchema) {
  EXPECT_EQ(load("schema = 'hallway.scenario/1'\n" + test::scenario_text()).seed, 5u);
}

TEST(LoadScenario, SaysWhereEverySettingCameFrom) {
  const Scenario scenario =
      load(test::scenario_text("[sensor.eyes]\nkind = 'points'\nnoise_m = 0.05\n"
                               "[[plugin]]\nname = 'slam'\nparams = {a = 0.1}\n"
                               "[[picture]]\nfile = 'a.png'\n"));
  EXPECT_EQ(setting(scenario, "seed"), "5 from s.toml:2");
  EXPECT_EQ(setting(scenario, "robot.loop_steps"), "20 from s.toml:7");
  EXPECT_EQ(setting(scenario, "robot.speed_m_s"), "none");
  EXPECT_EQ(setting(scenario, "sensor.eyes.noise_m"), "0.05 from s.toml:10");
  EXPECT_EQ(setting(scenario, "sensor.eyes.max_range_m"), "100 from default");
  EXPECT_EQ(setting(scenario, "sensor.eyes.position_m"), "[0, 0, 0] from default");
  EXPECT_EQ(setting(scenario, "plugin[1].name"), "slam from s.toml:12");
  EXPECT_EQ(setting(scenario, "slam.a"), "0.1 from s.toml:13");
  EXPECT_EQ(setting(scenario, "picture[1].view"), "top from default");
}

TEST(LoadScenario, DoesNotDependOnTheFolderThatItIsStartedFrom) {
  const test::TempFolder a;
  const test::TempFolder b;
  const auto settings_in = [](const test::TempFolder& folder) {
    std::string text;
    for (const Setting& entry : load_scenario(folder.write("s.toml", test::scenario_text())).settings) {
      text += entry.key + "|" + entry.value + "|" + entry.origin + "\n";
    }
    return text;
  };
  EXPECT_EQ(settings_in(a), settings_in(b));
}

}  // namespace
}  // namespace hallway::sim
