// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "mesh/model.hpp"

namespace hallway::test {

/// A unit cube around the origin in two materials.
inline mesh::Model cube() {
  mesh::Model model;
  for (int i = 0; i < 8; ++i)
    model.vertices.emplace_back((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5);
  const std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (std::uint32_t i = 0; i < 6; ++i) {
    const auto& [a, b, c, d] = sides[i];
    model.triangles.push_back({{a, b, c}, i / 3});
    model.triangles.push_back({{a, c, d}, i / 3});
  }
  model.materials = {{"red paint", {1.0F, 0.25F, 0.0F, 1.0F}, {}}, {"glass", {0.5F, 0.5F, 1.0F, 0.5F}, {}}};
  return model;
}

/// A square of 2 m in the plane z = 0 with a picture of 2 x 2 pixels on it twice along x, and a triangle in one colour.
inline mesh::Model tiles() {
  mesh::Model model;
  model.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 1}};
  model.uv = {{0.0F, 1.0F}, {2.0F, 1.0F}, {2.0F, 0.0F}, {0.0F, 0.0F}, {0.0F, 0.0F}};
  model.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}, {{0, 1, 4}, 1}};
  model.materials = {{"tiles", {1.0F, 0.5F, 0.25F, 1.0F}, 1}, {"plain", {0.5F, 0.5F, 0.5F, 1.0F}, {}}};
  model.images = {{"of nothing", 1, 1, {1, 2, 3, 255}},
                  {"four", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 8, 7, 255}}};
  return model;
}

/// Triangles at random places, in random order of materials, some sharing vertices.
inline mesh::Model random_model(std::uint64_t seed, std::size_t triangles) {
  const Random random(seed, stream_id("test.random_model"));
  mesh::Model model;
  const std::size_t vertices = triangles + 3;
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto word = random.bits(0, i);
    const auto number = [&](std::size_t k) {
      return static_cast<double>(word[k]) / 4294967296.0 * 40.0 - 20.0;
    };
    model.vertices.emplace_back(number(0), number(1), number(2));
  }
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto word = random.bits(1, i);
    const auto index = [&](std::size_t k) { return static_cast<std::uint32_t>(word[k] % vertices); };
    model.triangles.push_back({{index(0), index(1), index(2)}, word[3] % 3});
  }
  model.materials.resize(3);
  return model;
}

}  // namespace hallway::test
