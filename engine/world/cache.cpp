// SPDX-License-Identifier: MIT
#include "world/cache.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "base/byte_archive.hpp"
#include "base/hash.hpp"

namespace hallway::world {
namespace {

constexpr std::string_view kMagic = "hallway.world/2\n";
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Plane) == 4 * sizeof(double));

struct Saver : ByteSaver<ByteAppender> {
  using ByteSaver::ByteSaver;
};
struct Loader : ByteLoader<ByteReader> {
  using ByteLoader::ByteLoader;
};

template <typename Archive>
void pass(Archive& archive, Passed<Archive, Vec3>& v) {
  archive.values(v[0], v[1], v[2]);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, Plane>& plane) {
  pass(archive, plane.normal);
  archive.values(plane.offset);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, Box>& box) {
  pass(archive, box.min());
  pass(archive, box.max());
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Child>& child) {
  std::uint32_t bits = child.bits();
  archive.values(bits);
  if constexpr (Archive::kReads) child = bsp::Child(bits);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, Polygon>& polygon) {
  pass(archive, polygon.plane);
  pass_all(archive, polygon.vertices, sizeof(Vec3));
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, csg::SurfacePolygon>& polygon) {
  pass(archive, polygon.plane);
  archive.lists(polygon.vertices);
  archive.values(polygon.solid, polygon.face);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Node>& node) {
  archive.values(node.offset);
  for (auto& child : node.child) pass(archive, child);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Leaf>& leaf) {
  archive.template value_as<std::uint8_t>(leaf.content);
  archive.values(leaf.cluster);
  pass(archive, leaf.box);
  archive.values(leaf.first_face, leaf.face_count);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Tree>& tree) {
  archive.length(tree.nodes, sizeof(double));
  pass(archive, tree.root);
  for (auto& node : tree.nodes) pass(archive, node);
  pass_all(archive, tree.normals, sizeof(Vec3));
  pass_all(archive, tree.leaves);
  archive.lists(tree.leaf_faces);
  pass(archive, tree.bounds);
  archive.values(tree.clusters);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Portal>& portal) {
  pass(archive, portal.polygon);
  archive.values(portal.cluster[0], portal.cluster[1]);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Leak>& leak) {
  archive.values(leak.occupant);
  pass_all(archive, leak.way, sizeof(Vec3));
  archive.values(leak.length_m);
  pass(archive, leak.narrowest.at);
  archive.values(leak.narrowest.width_m, leak.narrowest.height_m);
  pass_all(archive, leak.narrowest.polygons);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Enclosure>& enclosure) {
  archive.template value_as<std::uint8_t>(enclosure.sealed);
  archive.lists(enclosure.in_solid);
  archive.lists(enclosure.leaking);
  bool leaks = enclosure.leak.has_value();
  archive.template value_as<std::uint8_t>(leaks);
  if constexpr (Archive::kReads) {
    if (leaks) enclosure.leak.emplace();
  }
  if (leaks) pass(archive, *enclosure.leak);
}
template <typename Archive>
void pass(Archive& archive, Passed<Archive, bsp::Compiled>& partition) {
  pass_all(archive, partition.surface.vertices, sizeof(Vec3));
  pass_all(archive, partition.surface.polygons, sizeof(Plane));
  if constexpr (Archive::kReads) partition.inside.resize(partition.surface.polygons.size());
  for (std::size_t i = 0; i < partition.inside.size(); ++i) {
    bool inside = partition.inside[i];
    archive.template value_as<std::uint8_t>(inside);
    if constexpr (Archive::kReads) partition.inside[i] = inside;
  }
  pass(archive, partition.tree);
  archive.values(partition.portals.clusters);
  pass_all(archive, partition.portals.portals);
  pass(archive, partition.enclosure);
}

void put_visible(ByteAppender& out, const std::optional<pvs::VisibleSets>& visible) {
  out.put(static_cast<std::uint8_t>(visible.has_value()));
  if (!visible) return;
  out.put(visible->clusters());
  for (std::uint32_t c = 0; c < visible->clusters(); ++c) out.put_list(visible->visible_from(c));
}

std::optional<pvs::VisibleSets> get_visible(ByteReader& in) {
  if (in.get<std::uint8_t>() == 0) return std::nullopt;
  const auto clusters = in.get<std::uint32_t>();
  std::vector<std::vector<std::uint8_t>> rows;
  for (std::uint32_t c = 0; c < clusters; ++c) {
    std::vector<std::uint8_t>& row = rows.emplace_back((clusters + 7) / 8, std::uint8_t{0});
    for (const std::uint32_t to : in.copy_list<std::uint32_t>()) {
      if (to >= clusters) throw BadBytes{"a cluster that is not there"};
      row[to / 8] = static_cast<std::uint8_t>(row[to / 8] | (1u << (to % 8)));
    }
  }
  return pvs::VisibleSets(rows);
}

}  // namespace

std::string encode(const bsp::Compiled& partition, const std::optional<pvs::VisibleSets>& visible) {
  std::string body;
  ByteAppender out(body);
  Saver saver(out);
  pass(saver, partition);
  put_visible(out, visible);
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
  try {
    ByteReader in(bytes);
    Loader loader(in);
    Cached cached;
    pass(loader, cached.partition);
    cached.visible = get_visible(in);
    in.expect_end();
    return cached;
  } catch (const BadBytes&) {
    return std::nullopt;
  }
}

}  // namespace hallway::world
