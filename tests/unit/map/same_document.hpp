// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstring>
#include <optional>
#include <string>

#include "map/document.hpp"

namespace hallway::map::test {

inline bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

inline bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

inline bool same_flags(const std::optional<SurfaceFlags>& a, const std::optional<SurfaceFlags>& b) {
  if (!a || !b) return !a && !b;
  return a->contents == b->contents && a->flags == b->flags && same_bits(a->value, b->value);
}

inline bool same_matrix(const std::optional<std::array<double, 6>>& a,
                        const std::optional<std::array<double, 6>>& b) {
  if (!a || !b) return !a && !b;
  return std::memcmp(a->data(), b->data(), sizeof *a) == 0;
}

/// Equal in everything but line numbers; numbers are compared bit by bit.
inline bool same_face(const Face& a, const Face& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!same_bits(a.points[i], b.points[i])) return false;
  }
  return a.comments == b.comments && a.material == b.material && same_bits(a.u_axis, b.u_axis) &&
         same_bits(a.v_axis, b.v_axis) && same_bits(a.u_offset, b.u_offset) &&
         same_bits(a.v_offset, b.v_offset) && same_bits(a.rotation_deg, b.rotation_deg) &&
         same_bits(a.u_scale, b.u_scale) && same_bits(a.v_scale, b.v_scale) &&
         same_flags(a.surface_flags, b.surface_flags) && same_matrix(a.texture_matrix, b.texture_matrix);
}

/// What differs between two documents, apart from line numbers and the file's name; empty where nothing does.
inline std::string difference(const Document& a, const Document& b) {
  if (a.closing_comments != b.closing_comments) return "comments at the end";
  if (a.entities.size() != b.entities.size()) return "number of entities";
  for (std::size_t e = 0; e < a.entities.size(); ++e) {
    const Entity& x = a.entities[e];
    const Entity& y = b.entities[e];
    const std::string entity = "entity " + std::to_string(e) + ": ";
    if (x.comments != y.comments || x.closing_comments != y.closing_comments) return entity + "comments";
    if (x.keys.size() != y.keys.size()) return entity + "number of keys";
    for (std::size_t k = 0; k < x.keys.size(); ++k) {
      if (x.keys[k].key != y.keys[k].key || x.keys[k].value != y.keys[k].value ||
          x.keys[k].comments != y.keys[k].comments) {
        return entity + "key " + x.keys[k].key;
      }
    }
    if (x.brushes.size() != y.brushes.size()) return entity + "number of brushes";
    for (std::size_t i = 0; i < x.brushes.size(); ++i) {
      const Brush& p = x.brushes[i];
      const Brush& q = y.brushes[i];
      const std::string brush = entity + "brush " + std::to_string(i) + ": ";
      if (p.comments != q.comments || p.closing_comments != q.closing_comments) return brush + "comments";
      if (p.unread != q.unread) return brush + "unread shape";
      if (p.faces.size() != q.faces.size()) return brush + "number of faces";
      for (std::size_t f = 0; f < p.faces.size(); ++f) {
        if (!same_face(p.faces[f], q.faces[f])) return brush + "face " + std::to_string(f);
      }
    }
  }
  return {};
}

}  // namespace hallway::map::test
