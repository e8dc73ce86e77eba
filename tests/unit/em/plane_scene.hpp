// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/file.hpp"
#include "base/random.hpp"
#include "base/toml_reader.hpp"
#include "em/core/types.hpp"

namespace hallway::em::planted {

/// One [[plane]] of a scene (maps/regress/em/README.md).
struct ScenePlane {
  std::string name;
  Vec3 centre, normal, axis_u;
  double half_u = 0.0, half_v = 0.0;
  std::size_t points = 0;
  double sigma = 0.0;

  Vec3 axis_v() const { return normal.cross(axis_u); }
};

using Params = std::vector<std::pair<std::string, double>>;

/// One [[fault]]: what an algorithm does with a bad value.
struct ExpectedFault {
  std::string algorithm;
  Params params, bad;
  std::string shows, plane, from;
};

/// One [[expect]]: a plane of the right answer, and those that it reaches.
struct ExpectedPlane {
  std::string plane;
  std::vector<std::string> meets;
};

struct Scene {
  std::uint64_t seed = 0;
  std::vector<ScenePlane> planes;
  std::vector<ExpectedPlane> expected;
  std::vector<ExpectedFault> faults;

  std::size_t index_of(const std::string& name) const {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (planes[i].name == name) return i;
    }
    throw std::invalid_argument("no plane is called " + name);
  }
};

namespace detail {

inline const TomlNode& need(const TomlTable& table, const char* key) {
  const TomlNode* node = find(table, key);
  if (node == nullptr) throw std::invalid_argument(std::string("no key ") + key);
  return *node;
}

inline double number(const TomlNode& node) {
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*whole);
  return std::get<double>(node.value);
}

inline std::string text_or_nothing(const TomlTable& table, const char* key) {
  const TomlNode* node = find(table, key);
  return node == nullptr ? "" : std::get<std::string>(node->value);
}

inline Vec3 vector(const TomlNode& node) {
  const auto& array = std::get<TomlArray>(node.value);
  return {number(array.at(0)), number(array.at(1)), number(array.at(2))};
}

inline Params params(const TomlTable& table, const char* key) {
  Params values;
  if (const TomlNode* node = find(table, key)) {
    for (const TomlEntry& entry : std::get<TomlTable>(node->value))
      values.emplace_back(entry.key, number(entry.node));
  }
  return values;
}

inline std::vector<const TomlTable*> tables(const TomlTable& root, const char* key) {
  std::vector<const TomlTable*> rows;
  if (const TomlNode* node = find(root, key)) {
    for (const TomlNode& row : std::get<TomlArray>(node->value))
      rows.push_back(&std::get<TomlTable>(row.value));
  }
  return rows;
}

inline ScenePlane plane(const TomlTable& row) {
  ScenePlane plane;
  plane.name = std::get<std::string>(need(row, "name").value);
  plane.centre = vector(need(row, "centre_m"));
  plane.normal = vector(need(row, "normal"));
  plane.axis_u = vector(need(row, "axis_u"));
  plane.half_u = number(need(row, "half_u_m"));
  plane.half_v = number(need(row, "half_v_m"));
  plane.points = static_cast<std::size_t>(number(need(row, "points")));
  plane.sigma = number(need(row, "sigma_m"));
  return plane;
}

inline ExpectedPlane expected(const TomlTable& row) {
  ExpectedPlane expected;
  expected.plane = std::get<std::string>(need(row, "plane").value);
  if (const TomlNode* meets = find(row, "meets")) {
    for (const TomlNode& name : std::get<TomlArray>(meets->value)) {
      expected.meets.push_back(std::get<std::string>(name.value));
    }
  }
  return expected;
}

inline ExpectedFault fault(const TomlTable& row) {
  ExpectedFault fault;
  fault.algorithm = std::get<std::string>(need(row, "algorithm").value);
  fault.shows = std::get<std::string>(need(row, "shows").value);
  fault.params = params(row, "params");
  fault.bad = params(row, "bad");
  fault.plane = text_or_nothing(row, "plane");
  fault.from = text_or_nothing(row, "from");
  return fault;
}

}  // namespace detail

inline Scene read_scene(const std::filesystem::path& file) {
  const TomlTable root = parse_toml(read_file(file), file.string());
  Scene scene;
  scene.seed = static_cast<std::uint64_t>(detail::number(detail::need(root, "seed")));
  for (const TomlTable* row : detail::tables(root, "plane")) scene.planes.push_back(detail::plane(*row));
  for (const TomlTable* row : detail::tables(root, "expect"))
    scene.expected.push_back(detail::expected(*row));
  for (const TomlTable* row : detail::tables(root, "fault")) scene.faults.push_back(detail::fault(*row));
  return scene;
}

/// The points of a scene and the plane that each comes from.
struct LabelledCloud {
  std::vector<Vec3> points;
  std::vector<std::size_t> labels;
};

inline LabelledCloud sample(const Scene& scene) {
  const Random random(scene.seed, stream_id("planes.points"));
  LabelledCloud cloud;
  for (std::size_t p = 0; p < scene.planes.size(); ++p) {
    const ScenePlane& plane = scene.planes[p];
    const auto step = static_cast<std::uint32_t>(p);
    for (std::uint64_t i = 0; i < plane.points; ++i) {
      const double u = random.uniform(step, 5 * i, -plane.half_u, plane.half_u);
      const double v = random.uniform(step, 5 * i + 1, -plane.half_v, plane.half_v);
      const Vec3 noise(random.normal(step, 5 * i + 2), random.normal(step, 5 * i + 3),
                       random.normal(step, 5 * i + 4));
      cloud.points.push_back(plane.centre + u * plane.axis_u + v * plane.axis_v() + plane.sigma * noise);
      cloud.labels.push_back(p);
    }
  }
  return cloud;
}

}  // namespace hallway::em::planted
