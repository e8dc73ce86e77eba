// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bsp/build_options.hpp"
#include "geom/facet.hpp"

namespace hallway::bsp {

/// What choosing a plane needs to know of a facet.
struct FacetShape {
  std::uint32_t plane = 0;
  bool candidate = false;  ///< its plane may be chosen
  Vec3 middle = Vec3::Zero();
  Vec3 half = Vec3::Zero();  ///< its box is middle +- half
  double area = 0.0;
};

FacetShape shape_of(const Facet& facet);

/// The plane that divides these facets best; at least one must be a candidate. Facets that reach across a plane are told from their boxes, so
/// that a slanted one may be counted as cut where it is not. O(n * candidates).
std::uint32_t choose_plane(const PlaneSet& planes, std::span<const FacetShape> facets,
                           const BuildOptions& options);

}  // namespace hallway::bsp
