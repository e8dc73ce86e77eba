// SPDX-License-Identifier: MIT
#include "render/map_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/leaf_pieces.hpp"

namespace hallway::render {
namespace {

constexpr Rgb kPortal{0, 120, 190};
constexpr Rgb kOpening{240, 130, 0};
constexpr Rgb kSeenTint{255, 214, 102};
constexpr Rgb kHiddenTint{104, 110, 130};

/// Many portals over each other would hide the map: the more there are the thinner they are.
double portal_opacity(std::size_t portals) {
  return std::clamp(4.0 / std::sqrt(static_cast<double>(portals + 1)), 0.05, 0.3);
}

Rgb seen_colour(Rgb material) {
  return mix(material, kSeenTint, 0.5);
}

Rgb hidden_colour(Rgb material) {
  return mix(material, kHiddenTint, 0.85);
}

/// Dark blue for shallow leaves to light yellow for deep ones, in even steps of lightness.
constexpr std::array<Rgb, 6> kDepths{
    {{52, 60, 110}, {46, 98, 140}, {44, 140, 146}, {84, 178, 128}, {170, 208, 100}, {250, 228, 120}}};
constexpr std::size_t kDepthSteps = 24;

Rgb depth_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(kDepths.size() - 1);
  const std::size_t low = std::min(kDepths.size() - 2, static_cast<std::size_t>(at));
  return mix(kDepths[low], kDepths[low + 1], at - static_cast<double>(low));
}

/// Least and greatest depth of the empty leaves.
std::pair<std::uint32_t, std::uint32_t> depth_range(const bsp::Tree& tree) {
  const std::vector<std::uint32_t> depths = leaf_depths(tree);
  std::pair<std::uint32_t, std::uint32_t> range{0, 0};
  bool first = true;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (tree.leaves[i].content != bsp::Content::kEmpty) continue;
    range = first ? std::pair(depths[i], depths[i])
                  : std::pair(std::min(range.first, depths[i]), std::max(range.second, depths[i]));
    first = false;
  }
  return range;
}

}  // namespace

std::string measure_text(double metres) {
  return metres < 0.1 ? fmt::format("{:.1f} mm", 1000.0 * metres) : fmt::format("{:.2f} m", metres);
}

void add_portals(Picture& picture, const bsp::PortalGraph& portals) {
  if (portals.portals.empty()) return;
  Patches patches{
      .colour = kPortal,
      .opacity = portal_opacity(portals.portals.size()),
      .outline_px = portals.portals.size() > 1000 ? 0.8 : 1.8,
      .label = fmt::format("{} portals between {} clusters", portals.portals.size(), portals.clusters)};
  for (const bsp::Portal& portal : portals.portals) patches.polygons.push_back(portal.polygon.vertices);
  picture.patches.push_back(std::move(patches));
}

void add_leak(Picture& picture, const bsp::Leak& leak, const std::string& occupant) {
  const bsp::Opening& opening = leak.narrowest;
  const std::string size = opening.is_measured() ? fmt::format("{} × {}", measure_text(opening.width_m),
                                                               measure_text(opening.height_m))
                                                 : "gap of " + measure_text(opening.width_m);
  Patches patches{.colour = kOpening, .opacity = 0.5, .outline_px = 2.0};
  for (const Polygon& polygon : opening.polygons) patches.polygons.push_back(polygon.vertices);
  picture.patches.push_back(std::move(patches));
  picture.polylines.push_back({.points = leak.way,
                               .colour = palette::kError,
                               .width_px = 4.0,
                               .label = fmt::format("leak path, {}", measure_text(leak.length_m))});
  picture.markers.push_back({.positions = {leak.way.front()},
                             .shape = MarkerShape::kDot,
                             .colour = palette::kError,
                             .size_px = 12.0,
                             .label = occupant});
  if (opening.width_m > 0.0) {
    picture.markers.push_back({.positions = {opening.at},
                               .shape = MarkerShape::kRing,
                               .colour = kOpening,
                               .size_px = 22.0,
                               .label = "narrowest opening, " + size});
    picture.labels.push_back({.position = opening.at, .text = size});
  }
  picture.markers.push_back({.positions = {leak.way.back()},
                             .shape = MarkerShape::kCross,
                             .colour = palette::kError,
                             .size_px = 15.0,
                             .label = "in the void"});
  picture.labels.push_back({.position = leak.way.front(), .text = occupant});
}

void add_wireframe(Picture& picture, const csg::Surface& surface, const std::vector<bool>& inside,
                   Faces faces) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
    if (faces == Faces::kInside && !inside[i]) continue;
    const std::vector<std::uint32_t>& corners = surface.polygons[i].vertices;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      edges.push_back(std::minmax(corners[k], corners[(k + 1) % corners.size()]));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  Segments lines{.colour = palette::kInk,
                 .width_px = edges.size() > 5000 ? 0.7 : 1.1,
                 .opacity = edges.size() > 5000 ? 0.55 : 0.75,
                 .label = fmt::format("{} edges", edges.size())};
  for (const auto& [from, to] : edges) lines.pairs.push_back({surface.vertices[from], surface.vertices[to]});
  picture.segments.push_back(std::move(lines));
}

LeafColour sight_colours(const bsp::Tree& tree, const std::vector<bool>& seen) {
  return [&tree, seen](std::uint32_t leaf, Rgb material) {
    const std::int32_t cluster = tree.leaves[leaf].cluster;
    const bool visible = cluster >= 0 && seen[static_cast<std::size_t>(cluster)];
    return visible ? seen_colour(material) : hidden_colour(material);
  };
}

void add_sight_legend(Picture& picture, const std::vector<bool>& seen) {
  const auto visible = std::count(seen.begin(), seen.end(), true);
  picture.swatches.push_back({seen_colour(material_colour("wall")),
                              fmt::format("may be seen: {} of {} clusters", visible, seen.size())});
  picture.swatches.push_back({hidden_colour(material_colour("wall")), "hidden for certain"});
}

LeafColour depth_colours(const bsp::Tree& tree) {
  const auto [low, high] = depth_range(tree);
  const double span = std::max(1.0, static_cast<double>(high - low));
  std::vector<Rgb> colours;
  for (const std::uint32_t depth : leaf_depths(tree)) {
    colours.push_back(depth_colour((static_cast<double>(depth) - static_cast<double>(low)) / span));
  }
  return [colours = std::move(colours)](std::uint32_t leaf, Rgb) { return colours[leaf]; };
}

void add_depth_legend(Picture& picture, const bsp::Tree& tree) {
  const auto [low, high] = depth_range(tree);
  for (std::size_t i = 0; i < kDepthSteps; ++i) {
    picture.scale.colours.push_back(depth_colour(static_cast<double>(i) / (kDepthSteps - 1)));
  }
  picture.scale.label = fmt::format("nodes above the leaf: {} to {}", low, high);
}

}  // namespace hallway::render
