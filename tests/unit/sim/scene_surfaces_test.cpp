// SPDX-License-Identifier: MIT
#include "sim/scene_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "sense/occluders.hpp"
#include "sim/simulator.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

/// A block of one material.
std::string block_of(const std::string& material, int x0, int y0, int x1, int y1) {
  std::string text = hallway::test::block(x0, y0, -100, x1, y1, 100);
  for (std::size_t at = 0; (at = text.find("wall [", at)) != std::string::npos; at += material.size())
    text.replace(at, 4, material);
  return text;
}

std::size_t triangle_count(const Simulator& simulator) {
  return sense::make_occluders(simulator.compiled().partition.surface, triangles_of(simulator.models()))
      .triangles.size();
}

/// Blocks of glass (ahead of the first pose), of paint (behind it) and of a wall (to the left), seen by a scanner.
class MaterialsOfAScene : public testing::Test {
 protected:
  std::unique_ptr<Simulator> simulator(const std::string& materials, const std::string& of_map = "",
                                       const std::string& lidar = "") {
    std::string map = hallway::test::map_text(block_of("base/GLASS_1", 300, -500, 320, 500) +
                                              block_of("paint", -320, -500, -300, 500) +
                                              block_of("wall", -200, 300, 200, 320));
    if (!of_map.empty()) map.insert(map.find("\"_scale\""), "\"_materials\" \"" + of_map + "\"\n");
    folder_.write("small.map", map);
    const std::string scanner =
        "[sensor.scanner]\nkind = 'lidar'\nrings = 1\nlowest_deg = 0\nhighest_deg = 0\ncolumns = "
        "720\nstep_deg = 0.5\n" +
        lidar;
    return std::make_unique<Simulator>(
        load_scenario(folder_.write("s.toml", hallway::test::scenario_text(scanner + materials))), 1,
        trace::Backend::kBruteForce);
  }

  /// Which block a place is on.
  static const char* material_at(const Vec3& place) {
    if (std::abs(place.x() - 3.0) < 1e-6) return "base/GLASS_1";
    if (std::abs(place.x() + 3.0) < 1e-6) return "paint";
    return std::abs(place.y() - 3.0) < 1e-6 ? "wall" : "";
  }

  /// Compares the intensities of the first scan with those of materials by the places that rays reach.
  template <typename Reflectance>
  void expect_intensities(const Simulator& simulator, const Reflectance& reflectance_of) {
    const Frame frame = simulator.step(1);
    ASSERT_EQ(frame.readings.size(), 1u);
    const auto& spec = std::get<sense::LidarSpec>(simulator.scenario().sensors[0]);
    const auto& [scan, truth] = std::get<LidarSensed>(frame.readings[0].sensed);
    int compared = 0;
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      if (!std::isfinite(scan.range_m[i])) continue;
      const Pose at = simulator.pose_at_time(frame.readings[0].t_begin_ns + simulator.offsets_ns(0)[i]);
      const double azimuth = spec.pattern.rays[i].azimuth_rad;
      const Vec3 direction = at.q * Vec3(std::cos(azimuth), std::sin(azimuth), 0.0);
      const std::string material = material_at(at.t + scan.range_m[i] * direction);
      if (material.empty()) continue;  // a short side
      const double cosine = material == "wall" ? std::abs(direction.y()) : std::abs(direction.x());
      EXPECT_NEAR(scan.intensity[i], reflectance_of(material) * cosine, 1e-6) << material;
      ++compared;
    }
    EXPECT_GT(compared, 400);
  }

  hallway::test::TempFolder folder_;
};

TEST_F(MaterialsOfAScene, WithoutATableReflectHalf) {
  expect_intensities(*simulator(""), [](const std::string&) { return 0.5; });
}

TEST_F(MaterialsOfAScene, ReflectAsTheScenarioSays) {
  expect_intensities(
      *simulator("[material.'glass*']\nreflectance = 0.1\n[material.paint]\nreflectance = 0.9\n"),
      [](const std::string& material) { return material == "paint"  ? 0.9
                                               : material == "wall" ? 0.5
                                                                    : 0.1; });
}

TEST_F(MaterialsOfAScene, TheScenarioGoesBeforeTheMapsTable) {
  folder_.write(
      "mine.toml",
      "schema = \"hallway.materials/1\"\n[material.glass_1]\nreflectance = 0.2\n[material.wall]\nreflectance "
      "= 0.7\n");
  const auto both = simulator("[material.'glass*']\nreflectance = 0.1\n", "mine.toml");
  expect_intensities(*both, [](const std::string& material) {
    return material == "paint" ? 0.5 : material == "wall" ? 0.7 : 0.1;
  });
  const auto& settings = both->scenario().settings;
  EXPECT_TRUE(std::ranges::any_of(settings, [](const Setting& setting) {
    return setting.key == "material.wall.reflectance" && setting.value == "0.7" &&
           setting.origin.ends_with("mine.toml:5");
  }));
}

TEST_F(MaterialsOfAScene, LoseBeamsAsTheirShareSays) {
  const auto lossy = simulator("[material.'glass*']\nlidar_dropout = 0.3\n");
  const auto whole = simulator("");
  const SceneLabels labels = label_scene(lossy->compiled(), lossy->models());
  double beams = 0.0, lost = 0.0;
  for (std::uint32_t step = 1; step < 40; ++step) {
    const Frame with = lossy->step(step), without = whole->step(step);
    const auto &a = std::get<LidarSensed>(with.readings[0].sensed).reading,
               &b = std::get<LidarSensed>(without.readings[0].sensed).reading;
    const auto& truth = std::get<LidarSensed>(with.readings[0].sensed).truth;
    for (std::size_t i = 0; i < a.range_m.size(); ++i) {
      const std::uint32_t triangle = truth.what[i];
      const bool is_glass = triangle < labels.of_triangle.size() &&
                            labels.labels[labels.of_triangle[triangle]].material == "base/GLASS_1";
      if (is_glass) {
        beams += 1.0;
        lost += std::isnan(a.range_m[i]) ? 1.0 : 0.0;
      } else {
        EXPECT_EQ(std::isfinite(a.range_m[i]), std::isfinite(b.range_m[i]));
      }
    }
  }
  EXPECT_GT(beams, 3000.0);
  EXPECT_NEAR(lost / beams, 0.3, 3.0 * std::sqrt(0.3 * 0.7 / beams));
}

TEST_F(MaterialsOfAScene, LabelsNameBrushAndMaterial) {
  const auto world = simulator("");
  const SceneLabels labels = label_scene(world->compiled(), world->models());
  EXPECT_EQ(labels.of_triangle.size(), triangle_count(*world));
  ASSERT_EQ(labels.labels.size(), 3u);
  EXPECT_TRUE(std::ranges::find(labels.labels, SurfaceLabel{"entity 0, brush 0", "base/GLASS_1"}) !=
              labels.labels.end());
  EXPECT_TRUE(std::ranges::find(labels.labels, SurfaceLabel{"entity 0, brush 2", "wall"}) !=
              labels.labels.end());
}

TEST_F(MaterialsOfAScene, LabelsOfReturnsAreOfWhereTheyAre) {
  const auto world = simulator("", "", "labels = true\nnoise_m = 0.001\n");
  const SceneLabels scene = label_scene(world->compiled(), world->models());
  const Frame frame = world->step(1);
  const auto& spec = std::get<sense::LidarSpec>(world->scenario().sensors[0]);
  const auto& [scan, truth] = std::get<LidarSensed>(frame.readings[0].sensed);
  ASSERT_EQ(truth.returned.size(), scan.range_m.size());
  int compared = 0;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    EXPECT_EQ(std::isfinite(scan.range_m[i]), truth.returned[i] != sense::LidarTruth::kNothing);
    if (!std::isfinite(scan.range_m[i])) continue;
    const Pose at = world->pose_at_time(frame.readings[0].t_begin_ns + world->offsets_ns(0)[i]);
    const double azimuth = spec.pattern.rays[i].azimuth_rad;
    const std::string material =
        material_at(at.t + truth.range_m[i] * (at.q * Vec3(std::cos(azimuth), std::sin(azimuth), 0.0)));
    if (material.empty()) continue;
    EXPECT_EQ(scene.labels[scene.of_triangle[truth.returned[i]]].material, material);
    ++compared;
  }
  EXPECT_GT(compared, 400);
}

TEST_F(MaterialsOfAScene, BadTablesAreRefused) {
  const auto error = hallway::test::error_of([&] { simulator("[material.glass]\nreflectance = 2\n"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().line, 16) << error->what();
  EXPECT_TRUE(hallway::test::error_of([&] { simulator("", "missing.toml"); }));
}

TEST_F(MaterialsOfAScene, WithoutATableAllHaveTheDefaults) {
  const auto world = simulator("");
  const trace::TriangleMesh mesh =
      sense::make_occluders(world->compiled().partition.surface, triangles_of(world->models()));
  const sense::SurfaceMaterial plain = undescribed_surfaces(mesh).material(0);
  const map::MaterialProperties defaults;
  EXPECT_EQ(plain.reflectivity, defaults.reflectance);
  EXPECT_EQ(plain.infrared, defaults.infrared);
  EXPECT_EQ(plain.transparency, defaults.transparency);
  EXPECT_NEAR(plain.echo_angle_rad, defaults.echo_deg * std::numbers::pi / 180.0, 1e-12);
}

/// A map that places a model of two materials, and a table that describes one of them.
TEST(MaterialsOfAModel, ThatATableDoesNotDescribeAreReported) {
  const hallway::test::TempFolder folder;
  folder.write("a.mtl", "newmtl oak_wood\nKd 1 1 1\nnewmtl steel\nKd 1 1 1\n");
  folder.write(
      "a.obj",
      "mtllib a.mtl\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 6 0 1\nusemtl oak_wood\nf 1 2 3\nusemtl steel\nf 1 2 4\n");
  folder.write("small.map",
               hallway::test::map_text(
                   hallway::test::pillars(),
                   "{\n\"classname\" \"hw_mesh\"\n\"origin\" \"0 0 0\"\n\"model\" \"a.obj\"\n}\n"));
  const auto problems = [&](const std::string& more) {
    const Simulator simulator(load_scenario(folder.write("s.toml", hallway::test::scenario_text(more))), 1,
                              trace::Backend::kEmbree);
    std::string texts;
    for (const Error& problem : simulator.problems()) texts += std::string(problem.what()) + "\n";
    return texts;
  };
  const std::string table = "[material.'*wood*']\ninfrared = 0.4\n";
  const std::string sonar = "[sensor.s]\nkind = 'sonar'\n", points = "[sensor.p]\nkind = 'points'\n";
  const std::string said = problems(sonar + table);
  EXPECT_NE(said.find("says nothing of `steel` of models"), std::string::npos) << said;
  EXPECT_EQ(said.find("oak_wood"), std::string::npos) << said;
  EXPECT_EQ(problems(sonar), "") << "without a table all have the defaults";
  EXPECT_EQ(problems(points + table), "") << "no sensor uses materials";
  EXPECT_EQ(problems(sonar + table + "[material.steel]\nlike = '*wood*'\n"), "");
}

TEST(MaterialsOfAModel, AreItsOwnNames) {
  Scenario scenario = load_scenario(hallway::test::source_folder() / "maps" / "office.toml");
  scenario.steps = 1;
  const Simulator simulator(scenario, 1, trace::Backend::kEmbree);
  const SceneLabels labels = label_scene(simulator.compiled(), simulator.models());
  std::size_t of_models = 0;
  for (std::size_t i = 0; i < simulator.models().meshes.size(); ++i) {
    of_models += simulator.models().meshes[i].triangles.size();
    EXPECT_FALSE(simulator.models().materials[i].empty());
  }
  EXPECT_EQ(labels.of_triangle.size(), triangle_count(simulator));
  if (of_models == 0) return;
  const SurfaceLabel& last = labels.labels[labels.of_triangle.back()];
  EXPECT_EQ(last.thing, "entity " + std::to_string(simulator.models().placements.back().entity));
}

}  // namespace
}  // namespace hallway::sim
