// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/random.hpp"
#include "bsp/tree.hpp"
#include "pvs/visible_sets.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::test {

/// Rooms of 10 by 8 by 3 m in a row along x. There are doors in the walls between them but for every third wall, so a room
/// sees only the rooms of its own three.
struct Rooms {
  static constexpr double kLength = 10.0;
  static constexpr double kHalfWidth = 4.0;
  static constexpr double kHeight = 3.0;

  explicit Rooms(std::uint32_t room_count) : count(room_count) {
    make_walls();
    make_tree();
    std::vector<std::vector<std::uint8_t>> rows(count, std::vector<std::uint8_t>((count + 7) / 8, 0));
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::uint32_t j = 0; j < count; ++j) {
        if (i / 3 == j / 3) rows[i][j / 8] = static_cast<std::uint8_t>(rows[i][j / 8] | 1u << (j % 8));
      }
    }
    visible = pvs::VisibleSets(rows);
  }

  std::uint32_t count;
  trace::TriangleMesh walls{};
  bsp::Tree tree{};
  pvs::VisibleSets visible{};

 private:
  double length() const { return kLength * count; }

  void add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    walls.add_polygon({{a, b, c, d}, {}});
  }

  /// A wall across the row from y0 to y1.
  void add_wall(double x, double y0, double y1) {
    add_quad({x, y0, 0}, {x, y1, 0}, {x, y1, kHeight}, {x, y0, kHeight});
  }

  void make_walls() {
    const double w = kHalfWidth;
    const double h = kHeight;
    const double l = length();
    add_quad({0, -w, 0}, {l, -w, 0}, {l, w, 0}, {0, w, 0});
    add_quad({0, -w, h}, {l, -w, h}, {l, w, h}, {0, w, h});
    add_quad({0, -w, 0}, {l, -w, 0}, {l, -w, h}, {0, -w, h});
    add_quad({0, w, 0}, {l, w, 0}, {l, w, h}, {0, w, h});
    for (std::uint32_t i = 0; i <= count; ++i) {
      const double x = kLength * i;
      const double door = i % 2 == 0 ? -1.5 : 1.0;
      if (i % 3 == 0 || i == count) {
        add_wall(x, -w, w);
      } else {
        add_wall(x, -w, door - 0.6);
        add_wall(x, door + 0.6, w);
      }
    }
  }

  void make_tree() {
    tree.clusters = count;
    tree.bounds = Box(Vec3(-10, -10, -10), Vec3(length() + 10, 10, 10));
    bsp::Leaf outside;
    outside.content = bsp::Content::kSolid;
    outside.box = tree.bounds;
    tree.leaves.push_back(outside);
    std::vector<bsp::Division> divisions;
    const auto cut = [&](const Vec3& normal, double offset, std::int32_t front, std::int32_t back) {
      divisions.push_back({{normal, offset}, {front, back}});
    };
    const auto next = [&] { return static_cast<std::int32_t>(divisions.size()) + 1; };
    // The void is leaf 0 (~0): in front of the planes of the hull, all of which point outward.
    cut(-Vec3::UnitX(), 0.0, ~0, next());
    cut(Vec3::UnitX(), length(), ~0, next());
    cut(-Vec3::UnitY(), kHalfWidth, ~0, next());
    cut(Vec3::UnitY(), kHalfWidth, ~0, next());
    cut(-Vec3::UnitZ(), 0.0, ~0, next());
    cut(Vec3::UnitZ(), kHeight, ~0, count == 1 ? ~1 : next());
    for (std::uint32_t i = 0; i < count; ++i) {
      bsp::Leaf leaf;
      leaf.cluster = static_cast<std::int32_t>(i);
      leaf.box = Box(Vec3(kLength * i, -kHalfWidth, 0), Vec3(kLength * (i + 1), kHalfWidth, kHeight));
      tree.leaves.push_back(leaf);
    }
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      const auto room = static_cast<std::int32_t>(i);
      cut(-Vec3::UnitX(), -kLength * (i + 1), ~(room + 1), i + 2 == count ? ~(room + 2) : next());
    }
    bsp::set_nodes(tree, divisions);
  }
};

}  // namespace hallway::test
