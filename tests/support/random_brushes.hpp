// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/brushes.hpp"

namespace hallway::test {

/// A brush and what it does.
struct Act {
  map::BrushRole role = map::BrushRole::kAdd;
  map::Brush brush{};
};

/// The acts as a map that applies them in their order.
inline map::Document document_of(const std::vector<Act>& acts, double metres_per_unit = 1.0) {
  MapMaker maker(metres_per_unit);
  int order = 0;
  for (const Act& act : acts) {
    if (act.role == map::BrushRole::kSubtract) {
      maker.subtract(act.brush, order++);
    } else if (act.role == map::BrushRole::kDetail) {
      maker.detail(act.brush, order++);
    } else {
      maker.add_later(act.brush, order++);
    }
  }
  return maker.document();
}

/// Kinds of random worlds.
enum class WorldKind {
  kGrid,       ///< boxes with corners in a grid of 6: coincident faces, edges and corners everywhere
  kDecimals,   ///< the same in tenths, which no double is
  kTurned,     ///< the same, turned
  kPrisms,     ///< triangles and trapezia on the grid: slanted coincident faces
  kPolyhedra,  ///< polyhedra in general position
  kSlivers,    ///< boxes whose faces are 1e-2 to 1e-5 units off a grid
};

inline constexpr std::array kWorldKinds{WorldKind::kGrid,   WorldKind::kDecimals,  WorldKind::kTurned,
                                        WorldKind::kPrisms, WorldKind::kPolyhedra, WorldKind::kSlivers};

/// True where no two brushes touch in an edge or a corner alone, so that the surface is a 2-manifold.
inline bool in_general_position(WorldKind kind) {
  return kind == WorldKind::kPolyhedra;
}

class RandomActs {
 public:
  RandomActs(WorldKind kind, std::uint64_t seed) : kind_(kind), random_(seed) {}

  /// Where a point of the grid, from 0 to 6, lies in map units; only for kinds on a grid.
  static Vec3 placed(WorldKind kind, const Vec3& point) {
    if (kind == WorldKind::kDecimals) return 0.1 * point + Vec3(100.3, -20.7, 3.9);
    if (kind == WorldKind::kTurned)
      return Eigen::Quaterniond(0.9, 0.2, -0.1, 0.35).normalized() * point + Vec3(11.7, -5.1, 8.3);
    return point;
  }

  std::vector<Act> make() {
    std::vector<Act> acts;
    const int count = upto(2, 10);
    for (int i = 0; i < count; ++i) {
      Act& act = acts.emplace_back();
      if (i > 0 && upto(0, 2) == 0) act.role = map::BrushRole::kSubtract;
      act.brush = brush();
      const std::string material = "m" + std::to_string(i);
      for (map::Face& face : act.brush.faces) face.material = material;
    }
    return acts;
  }

 private:
  int upto(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  std::array<double, 2> span() {
    const int low = upto(0, 5);
    return {static_cast<double>(low), static_cast<double>(upto(low + 1, 6))};
  }
  map::Brush whole_box() {
    const auto x = span(), y = span(), z = span();
    return box({x[0], y[0], z[0]}, {x[1], y[1], z[1]});
  }
  double off() {
    static constexpr std::array kOff{0.0, 0.0, 0.0, 1e-2, 1e-3, 1e-4, 1e-5, -1e-5, -1e-4, -1e-3};
    return kOff[random_() % kOff.size()];
  }

  map::Brush brush() {
    switch (kind_) {
      case WorldKind::kGrid:
      case WorldKind::kDecimals:
      case WorldKind::kTurned: {
        map::Brush made = whole_box();
        for (map::Face& face : made.faces) {
          for (Vec3& point : face.points) point = placed(kind_, point);
        }
        return made;
      }
      case WorldKind::kPrisms:
        return slanted();
      case WorldKind::kPolyhedra: {
        std::uniform_real_distribution<double> place(-1.5, 1.5);
        const double x = place(random_), y = place(random_);
        return random_polyhedron(random_, {x, y, place(random_)}, 1.0 + 0.3 * place(random_));
      }
      case WorldKind::kSlivers: {
        const auto x = span(), y = span(), z = span();
        const Vec3 low(x[0] + off(), y[0] + off(), z[0] + off());
        return box(low, {x[1] + off(), y[1] + off(), z[1] + off()});
      }
    }
    return {};
  }

  map::Brush slanted() {
    const auto x = span(), y = span(), z = span();
    const int axis = upto(0, 2);
    std::vector<Vec2> corners{{x[0], y[0]}, {x[1], y[0]}, {x[1], y[1]}, {x[0], y[1]}};
    corners.erase(corners.begin() + upto(0, 3));
    map::Brush made = prism(corners, z[0], z[1]);
    for (map::Face& face : made.faces) {
      for (Vec3& point : face.points) {
        const Vec3 p = point;
        for (int k = 0; k < 3; ++k) point[(k + axis) % 3] = p[k];  // a rotation of the axes: handedness stays
      }
    }
    return made;
  }

  WorldKind kind_;
  std::mt19937_64 random_;
};

/// Drops acts one at a time while the fault remains.
inline std::vector<Act> shrunk(std::vector<Act> acts,
                               const std::function<std::string(const std::vector<Act>&)>& fault_of) {
  for (std::size_t i = 0; i < acts.size();) {
    std::vector<Act> fewer = acts;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (!fewer.empty() && !fault_of(fewer).empty()) {
      acts = std::move(fewer);
      i = 0;
    } else {
      ++i;
    }
  }
  return acts;
}

inline std::string to_text(const std::vector<Act>& acts) {
  std::ostringstream out;
  out.precision(17);
  for (const Act& act : acts) {
    out << (act.role == map::BrushRole::kSubtract ? "subtract"
            : act.role == map::BrushRole::kDetail ? "detail"
                                                  : "add")
        << '\n';
    for (const map::Face& face : act.brush.faces) {
      for (const Vec3& point : face.points) out << "  (" << point.transpose() << ")";
      out << '\n';
    }
  }
  return out.str();
}

}  // namespace hallway::test
