// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "bsp/compile.hpp"
#include "map/document.hpp"
#include "map/occupants.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"

namespace hallway::test {

/// Writes map documents brush by brush. Coordinates are metres on a grid of 1/32 m or any others.
class WorldMaker {
 public:
  WorldMaker() {
    document_.entities.emplace_back();
    document_.entities[0].keys = {{"classname", "worldspawn"}, {"_scale", "0.03125"}};
  }

  /// The entity that the following brushes belong to; `order` counts for hw_add and hw_subtract.
  WorldMaker& begin(const std::string& classname, int order = 0) {
    document_.entities.emplace_back();
    document_.entities.back().add("classname", classname);
    if (order != 0) document_.entities.back().add("order", std::to_string(order));
    return *this;
  }

  WorldMaker& box(const Vec3& low, const Vec3& high) {
    return prism({{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}},
                 low.z(), high.z());
  }

  /// A polygon of the plan, counter-clockwise, between two heights.
  WorldMaker& prism(const std::vector<Vec2>& plan, double low, double high) {
    return extrude(plan, low, high, [](const Vec2& p, double z) { return Vec3(p.x(), p.y(), z); });
  }

  /// A polygon of the x-z plane, counter-clockwise as seen from -y, from y = `low` to `high`.
  WorldMaker& profile(const std::vector<Vec2>& side, double low, double high) {
    // (x, z, y) is left-handed, so the polygon is run through backward.
    return extrude({side.rbegin(), side.rend()}, low, high,
                   [](const Vec2& p, double y) { return Vec3(p.x(), y, p.y()); });
  }

  map::World world() const { return map::build_world(document_); }

 private:
  static map::Face face(const std::vector<Vec3>& counter_clockwise) {
    map::Face result;
    result.material = "wall";
    for (std::size_t i = 0; i < 3; ++i) result.points[i] = 32.0 * counter_clockwise[2 - i];
    return result;
  }

  template <typename Place>
  WorldMaker& extrude(const std::vector<Vec2>& loop, double low, double high, const Place& place) {
    map::Brush brush;
    std::vector<Vec3> bottom, top;
    for (const Vec2& p : loop) {
      bottom.insert(bottom.begin(), place(p, low));
      top.push_back(place(p, high));
    }
    brush.faces = {face(bottom), face(top)};
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2& a = loop[i];
      const Vec2& b = loop[(i + 1) % loop.size()];
      brush.faces.push_back(face({place(a, low), place(b, low), place(b, high)}));
    }
    document_.entities.back().brushes.push_back(std::move(brush));
    return *this;
  }

  map::Document document_;
};

/// A world with its answers, and somewhere inside it.
struct QueryWorld {
  std::string name;
  map::World world;
  bsp::Compiled compiled;
};

inline QueryWorld make_query_world(std::string name, map::World world, const std::vector<Vec3>& occupants_m) {
  bsp::Compiled compiled = bsp::compile(world, occupants_m, {});
  return {std::move(name), std::move(world), std::move(compiled)};
}

/// Rooms cut out of a block, doors between them, pillars, a ramp, steps, a wedge, an arch, detail, overlapping brushes. 20 m x 12 m x 4 m.
inline map::World rooms() {
  WorldMaker m;
  m.box({-1, -1, -1}, {21, 13, 5});
  m.begin("hw_subtract", 1).box({0, 0, 0}, {10, 12, 4}).box({10.5, 0, 0}, {20, 12, 4});
  m.begin("hw_subtract", 2).box({9.5, 5, 0}, {11, 6, 2.25});  // a door
  m.begin("hw_add", 3).box({4, 4, 0}, {4.5, 4.5, 4});         // a pillar
  m.box({4.25, 4.25, 0}, {5, 5, 3.5});                        // another that overlaps it
  m.profile({{12, 0}, {16, 0}, {16, 1.5}}, 1, 4);             // a ramp
  m.box({16, 1, 0}, {18, 4, 1.5});                            // and where it leads
  for (int i = 0; i < 4; ++i) m.box({1.0 + 0.5 * i, 8, 0}, {3.5, 10, 0.125 * (i + 1)});
  m.prism({{7, 8}, {8.5, 8.25}, {7.5, 10}}, 0, 3);  // a wedge
  m.begin("hw_add", 4);
  constexpr int kStones = 6;  // an arch
  for (int i = 0; i < kStones; ++i) {
    const auto at = [&](int k, double radius) {
      const double angle = std::numbers::pi * k / kStones;
      return Vec2(15.0 + radius * std::cos(angle), 1.5 + radius * std::sin(angle));
    };
    m.profile({at(i, 1.0), at(i, 1.5), at(i + 1, 1.5), at(i + 1, 1.0)}, 8, 8.5);
  }
  m.begin("hw_detail").box({1, 1, 0}, {1.75, 1.5, 0.75}).prism({{13, 10}, {14, 10.1}, {13.4, 11}}, 0.5, 2);
  return m.world();
}

/// Things that stand free in the void: nothing is sealed.
inline map::World open_ground() {
  WorldMaker m;
  m.box({-20, -20, -1}, {20, 20, 0});
  const Random random(3, stream_id("open ground"));
  for (std::uint32_t i = 0; i < 60; ++i) {
    const auto draw = [&](std::uint64_t n, double low, double high) {
      return random.uniform(i, n, low, high);
    };
    const Vec3 at(draw(0, -18, 18), draw(1, -18, 18), draw(2, -0.5, 2.0));
    if (i % 3 == 0) {
      m.box(at, at + Vec3(draw(3, 0.2, 4), draw(4, 0.2, 4), draw(5, 0.1, 3)));
    } else if (i % 3 == 1) {
      m.prism({{at.x(), at.y()},
               {at.x() + draw(3, 1, 4), at.y() + draw(4, -0.9, 0.9)},
               {at.x() + 0.3, at.y() + draw(5, 1, 3)}},
              at.z(), at.z() + draw(6, 0.05, 2));
    } else {
      m.profile({{at.x(), at.z()},
                 {at.x() + draw(3, 1, 4), at.z() + draw(4, -0.5, 0.5)},
                 {at.x() + 0.3, at.z() + draw(5, 0.7, 3)}},
                at.y(), at.y() + draw(6, 0.1, 3));
    }
  }
  m.begin("hw_subtract", 1).box({-5, -5, -0.5}, {5, 5, 1.0});
  return m.world();
}

/// The worlds made here, compiled.
inline std::vector<QueryWorld> made_worlds() {
  std::vector<QueryWorld> worlds;
  worlds.push_back(make_query_world("rooms", rooms(), {{1, 6, 1}}));
  worlds.push_back(make_query_world("open ground", open_ground(), {}));
  return worlds;
}

/// A map file, compiled with its occupants.
inline QueryWorld load_query_world(const std::filesystem::path& path) {
  const map::Document document = map::load(path);
  std::vector<Vec3> places;
  for (const map::Occupant& occupant : map::occupants(document)) places.push_back(occupant.position_m);
  return make_query_world(path.filename().string(), map::build_world(document), places);
}

}  // namespace hallway::test
