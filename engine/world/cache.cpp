// SPDX-License-Identifier: MIT
#include "world/cache.hpp"

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/hash.hpp"

namespace hallway::world {
namespace {

constexpr std::string_view kMagic = "hallway.world/2\n";
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Plane) == 4 * sizeof(double));

/// A value of a compilation, as it is walked through: changed where it is read.
template <typename Archive, typename T>
using Of = std::conditional_t<Archive::kReads, T, const T>;

/// Writes the values that pass() walks through.
class Writer {
 public:
  static constexpr bool kReads = false;
  explicit Writer(ByteAppender& out) : out_(out) {}

  template <typename... Numbers>
  void numbers(const Numbers&... values) {
    (out_.put(values), ...);
  }
  /// A value that stands there as a T.
  template <typename T, typename Value>
  void number_as(const Value& value) {
    out_.put(static_cast<T>(value));
  }
  template <typename T>
  void list(const std::vector<T>& values) {
    out_.put_list(values);
  }
  /// The length of a list whose items pass() then walks through.
  template <typename T>
  void length(const std::vector<T>& items, std::size_t) {
    out_.put(std::uint64_t{items.size()});
  }

 private:
  ByteAppender& out_;
};

/// Reads them back, in the same way.
class Reader {
 public:
  static constexpr bool kReads = true;
  explicit Reader(ByteReader& in) : in_(in) {}

  template <typename... Numbers>
  void numbers(Numbers&... values) {
    ((values = in_.get<Numbers>()), ...);
  }
  template <typename T, typename Value>
  void number_as(Value& value) {
    value = static_cast<Value>(in_.get<T>());
  }
  template <typename T>
  void list(std::vector<T>& values) {
    values = in_.copy_list<T>();
  }
  template <typename T>
  void length(std::vector<T>& items, std::size_t least_bytes_each) {
    items.resize(in_.get_count(least_bytes_each));
  }

 private:
  ByteReader& in_;
};

template <typename Archive>
void pass(Archive& archive, Of<Archive, Vec3>& v) {
  archive.numbers(v[0], v[1], v[2]);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, Plane>& plane) {
  pass(archive, plane.normal);
  archive.numbers(plane.offset);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, Box>& box) {
  pass(archive, box.min());
  pass(archive, box.max());
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Child>& child) {
  std::uint32_t bits = child.bits();
  archive.numbers(bits);
  if constexpr (Archive::kReads) child = bsp::Child(bits);
}
template <typename Archive, typename Items>
void pass_all(Archive& archive, Items& items, std::size_t least_bytes_each = sizeof(double)) {
  archive.length(items, least_bytes_each);
  for (auto& item : items) pass(archive, item);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, Polygon>& polygon) {
  pass(archive, polygon.plane);
  pass_all(archive, polygon.vertices, sizeof(Vec3));
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, csg::SurfacePolygon>& polygon) {
  pass(archive, polygon.plane);
  archive.list(polygon.vertices);
  archive.numbers(polygon.solid, polygon.face);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Node>& node) {
  archive.numbers(node.offset);
  for (auto& child : node.child) pass(archive, child);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Leaf>& leaf) {
  archive.template number_as<std::uint8_t>(leaf.content);
  archive.numbers(leaf.cluster);
  pass(archive, leaf.box);
  archive.numbers(leaf.first_face, leaf.face_count);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Tree>& tree) {
  archive.length(tree.nodes, sizeof(double));
  pass(archive, tree.root);
  for (auto& node : tree.nodes) pass(archive, node);
  pass_all(archive, tree.normals, sizeof(Vec3));
  pass_all(archive, tree.leaves);
  archive.list(tree.leaf_faces);
  pass(archive, tree.bounds);
  archive.numbers(tree.clusters);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Portal>& portal) {
  pass(archive, portal.polygon);
  archive.numbers(portal.cluster[0], portal.cluster[1]);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Leak>& leak) {
  archive.numbers(leak.occupant);
  pass_all(archive, leak.way, sizeof(Vec3));
  archive.numbers(leak.length_m);
  pass(archive, leak.narrowest.at);
  archive.numbers(leak.narrowest.width_m, leak.narrowest.height_m);
  pass_all(archive, leak.narrowest.polygons);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Enclosure>& enclosure) {
  archive.template number_as<std::uint8_t>(enclosure.sealed);
  archive.list(enclosure.in_solid);
  archive.list(enclosure.leaking);
  bool leaks = enclosure.leak.has_value();
  archive.template number_as<std::uint8_t>(leaks);
  if constexpr (Archive::kReads) {
    if (leaks) enclosure.leak.emplace();
  }
  if (leaks) pass(archive, *enclosure.leak);
}
template <typename Archive>
void pass(Archive& archive, Of<Archive, bsp::Compiled>& partition) {
  pass_all(archive, partition.surface.vertices, sizeof(Vec3));
  pass_all(archive, partition.surface.polygons, sizeof(Plane));
  if constexpr (Archive::kReads) partition.inside.resize(partition.surface.polygons.size());
  for (std::size_t i = 0; i < partition.inside.size(); ++i) {
    bool inside = partition.inside[i];
    archive.template number_as<std::uint8_t>(inside);
    if constexpr (Archive::kReads) partition.inside[i] = inside;
  }
  pass(archive, partition.tree);
  archive.numbers(partition.portals.clusters);
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
  Writer writer(out);
  pass(writer, partition);
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
    Reader reader(in);
    Cached cached;
    pass(reader, cached.partition);
    cached.visible = get_visible(in);
    in.expect_end();
    return cached;
  } catch (const BadBytes&) {
    return std::nullopt;
  }
}

}  // namespace hallway::world
