// SPDX-License-Identifier: MIT
#include "world/cache.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "base/hash.hpp"
#include "world/byte_stream.hpp"

namespace hallway::world {
namespace {

constexpr std::string_view kMagic = "hallway.world/2\n";
constexpr std::size_t kVecBytes = 3 * sizeof(double);

void put(ByteWriter& out, const Vec3& v) {
  for (const double value : v) out.put(value);
}
void put(ByteWriter& out, const Plane& plane) {
  put(out, plane.normal);
  out.put(plane.offset);
}
void put(ByteWriter& out, const Box& box) {
  put(out, Vec3(box.min()));
  put(out, Vec3(box.max()));
}
void put(ByteWriter& out, const std::vector<Vec3>& points) {
  out.put(static_cast<std::uint64_t>(points.size()));
  for (const Vec3& point : points) put(out, point);
}
void put(ByteWriter& out, const Polygon& polygon) {
  put(out, polygon.plane);
  put(out, polygon.vertices);
}

Vec3 get_vec(ByteReader& in) {
  Vec3 v;
  for (double& value : v) value = in.get<double>();
  return v;
}
Plane get_plane(ByteReader& in) {
  Plane plane;
  plane.normal = get_vec(in);
  plane.offset = in.get<double>();
  return plane;
}
Box get_box(ByteReader& in) {
  Box box;
  box.min() = get_vec(in);
  box.max() = get_vec(in);
  return box;
}
std::vector<Vec3> get_points(ByteReader& in) {
  std::vector<Vec3> points(in.count(kVecBytes));
  for (Vec3& point : points) point = get_vec(in);
  return points;
}
Polygon get_polygon(ByteReader& in) {
  Polygon polygon;
  polygon.plane = get_plane(in);
  polygon.vertices = get_points(in);
  return polygon;
}

void put_surface(ByteWriter& out, const bsp::Compiled& partition) {
  put(out, partition.surface.vertices);
  out.put(static_cast<std::uint64_t>(partition.surface.polygons.size()));
  for (const csg::SurfacePolygon& polygon : partition.surface.polygons) {
    put(out, polygon.plane);
    out.put_all(polygon.vertices);
    out.put(polygon.solid);
    out.put(polygon.face);
  }
  for (const bool inside : partition.inside) out.put(static_cast<std::uint8_t>(inside));
}

void get_surface(ByteReader& in, bsp::Compiled& partition) {
  partition.surface.vertices = get_points(in);
  partition.surface.polygons.resize(in.count(sizeof(Plane)));
  for (csg::SurfacePolygon& polygon : partition.surface.polygons) {
    polygon.plane = get_plane(in);
    polygon.vertices = in.get_all<std::uint32_t>();
    polygon.solid = in.get<std::uint32_t>();
    polygon.face = in.get<std::uint32_t>();
  }
  for (std::size_t i = 0; i < partition.surface.polygons.size(); ++i) {
    partition.inside.push_back(in.get<std::uint8_t>() != 0);
  }
}

void put_tree(ByteWriter& out, const bsp::Tree& tree) {
  out.put(static_cast<std::uint64_t>(tree.nodes.size()));
  out.put(tree.root.bits());
  for (const bsp::Node& node : tree.nodes) {
    out.put(node.offset);
    for (const bsp::Child child : node.child) out.put(child.bits());
  }
  put(out, tree.normals);
  out.put(static_cast<std::uint64_t>(tree.leaves.size()));
  for (const bsp::Leaf& leaf : tree.leaves) {
    out.put(static_cast<std::uint8_t>(leaf.content));
    out.put(leaf.cluster);
    put(out, leaf.box);
    out.put(leaf.first_face);
    out.put(leaf.face_count);
  }
  out.put_all(tree.leaf_faces);
  put(out, tree.bounds);
  out.put(tree.clusters);
}

bsp::Tree get_tree(ByteReader& in) {
  bsp::Tree tree;
  tree.nodes.resize(in.count(sizeof(double)));
  tree.root = bsp::Child(in.get<std::uint32_t>());
  for (bsp::Node& node : tree.nodes) {
    node.offset = in.get<double>();
    for (bsp::Child& child : node.child) child = bsp::Child(in.get<std::uint32_t>());
  }
  tree.normals = get_points(in);
  tree.leaves.resize(in.count(sizeof(double)));
  for (bsp::Leaf& leaf : tree.leaves) {
    leaf.content = static_cast<bsp::Content>(in.get<std::uint8_t>());
    leaf.cluster = in.get<std::int32_t>();
    leaf.box = get_box(in);
    leaf.first_face = in.get<std::uint32_t>();
    leaf.face_count = in.get<std::uint32_t>();
  }
  tree.leaf_faces = in.get_all<std::uint32_t>();
  tree.bounds = get_box(in);
  tree.clusters = in.get<std::uint32_t>();
  return tree;
}

void put_portals(ByteWriter& out, const bsp::PortalGraph& graph) {
  out.put(graph.clusters);
  out.put(static_cast<std::uint64_t>(graph.portals.size()));
  for (const bsp::Portal& portal : graph.portals) {
    put(out, portal.polygon);
    for (const std::uint32_t cluster : portal.cluster) out.put(cluster);
  }
}

bsp::PortalGraph get_portals(ByteReader& in) {
  bsp::PortalGraph graph;
  graph.clusters = in.get<std::uint32_t>();
  graph.portals.resize(in.count(sizeof(double)));
  for (bsp::Portal& portal : graph.portals) {
    portal.polygon = get_polygon(in);
    for (std::uint32_t& cluster : portal.cluster) cluster = in.get<std::uint32_t>();
  }
  return graph;
}

void put_enclosure(ByteWriter& out, const bsp::Enclosure& enclosure) {
  out.put(static_cast<std::uint8_t>(enclosure.sealed));
  for (const auto* list : {&enclosure.in_solid, &enclosure.leaking}) out.put_all(*list);
  out.put(static_cast<std::uint8_t>(enclosure.leak.has_value()));
  if (!enclosure.leak) return;
  const bsp::Leak& leak = *enclosure.leak;
  out.put(leak.occupant);
  put(out, leak.way);
  out.put(leak.length_m);
  put(out, leak.narrowest.at);
  out.put(leak.narrowest.width_m);
  out.put(leak.narrowest.height_m);
  out.put(static_cast<std::uint64_t>(leak.narrowest.polygons.size()));
  for (const Polygon& polygon : leak.narrowest.polygons) put(out, polygon);
}

bsp::Enclosure get_enclosure(ByteReader& in) {
  bsp::Enclosure enclosure;
  enclosure.sealed = in.get<std::uint8_t>() != 0;
  for (auto* list : {&enclosure.in_solid, &enclosure.leaking}) *list = in.get_all<std::size_t>();
  if (in.get<std::uint8_t>() == 0) return enclosure;
  bsp::Leak& leak = enclosure.leak.emplace();
  leak.occupant = in.get<std::size_t>();
  leak.way = get_points(in);
  leak.length_m = in.get<double>();
  leak.narrowest.at = get_vec(in);
  leak.narrowest.width_m = in.get<double>();
  leak.narrowest.height_m = in.get<double>();
  leak.narrowest.polygons.resize(in.count(sizeof(double)));
  for (Polygon& polygon : leak.narrowest.polygons) polygon = get_polygon(in);
  return enclosure;
}

void put_visible(ByteWriter& out, const std::optional<pvs::VisibleSets>& visible) {
  out.put(static_cast<std::uint8_t>(visible.has_value()));
  if (!visible) return;
  out.put(visible->clusters());
  for (std::uint32_t c = 0; c < visible->clusters(); ++c) out.put_all(visible->visible_from(c));
}

std::optional<pvs::VisibleSets> get_visible(ByteReader& in) {
  if (in.get<std::uint8_t>() == 0) return std::nullopt;
  const auto clusters = in.get<std::uint32_t>();
  std::vector<std::vector<std::uint8_t>> rows;
  for (std::uint32_t c = 0; c < clusters && in.good(); ++c) {
    std::vector<std::uint8_t>& row = rows.emplace_back((clusters + 7) / 8, std::uint8_t{0});
    for (const std::uint32_t to : in.get_all<std::uint32_t>()) {
      if (to >= clusters) {
        in.fail();
        break;
      }
      row[to / 8] = static_cast<std::uint8_t>(row[to / 8] | (1u << (to % 8)));
    }
  }
  if (!in.good()) return std::nullopt;
  return pvs::VisibleSets(rows);
}

}  // namespace

std::string encode(const bsp::Compiled& partition, const std::optional<pvs::VisibleSets>& visible) {
  ByteWriter out;
  put_surface(out, partition);
  put_tree(out, partition.tree);
  put_portals(out, partition.portals);
  put_enclosure(out, partition.enclosure);
  put_visible(out, visible);
  const std::string body = out.take();
  return std::string(kMagic) + content_hash(body) + body;
}

std::optional<Cached> decode(std::string_view bytes) {
  constexpr std::size_t kHashBytes = 32;
  if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + kHashBytes) return std::nullopt;
  bytes.remove_prefix(kMagic.size());
  const std::string_view hash = bytes.substr(0, kHashBytes);
  bytes.remove_prefix(kHashBytes);
  // Content that has the hash is what encode() wrote: indices in it need no checking.
  if (content_hash(bytes) != hash) return std::nullopt;
  ByteReader in(bytes);
  Cached cached;
  get_surface(in, cached.partition);
  cached.partition.tree = get_tree(in);
  cached.partition.portals = get_portals(in);
  cached.partition.enclosure = get_enclosure(in);
  cached.visible = get_visible(in);
  if (!in.good() || !in.at_end()) return std::nullopt;
  return cached;
}

}  // namespace hallway::world
