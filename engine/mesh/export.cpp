// SPDX-License-Identifier: MIT
#include "mesh/export.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::mesh {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr std::size_t kMaxChannel = 255;

/// Every size is fine, but nothing else may be wrong.
void check_content(const Model& model) {
  if (model.triangles.empty()) return;
  constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
  check_model(model, {kAny, kAny, kAny, kAny, kAny, kAny});
}

template <typename T>
void append(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

/// Triangles of each material, in order.
std::vector<std::vector<std::size_t>> by_material(const Model& model) {
  std::vector<std::vector<std::size_t>> groups(model.materials.size());
  for (std::size_t i = 0; i < model.triangles.size(); ++i) groups[model.triangles[i].material].push_back(i);
  return groups;
}

/// Vertices and indices of one material's triangles, with vertices that it does not use left out.
struct Part {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> indices;
};

/// Numbers the vertices of one part after the other, in time proportional to the part.
class PartMaker {
 public:
  explicit PartMaker(const Model& model) : model_(model), place_(model.vertices.size(), kNone) {}

  Part make(const std::vector<std::size_t>& triangles) {
    Part part;
    for (const std::size_t triangle : triangles) {
      for (const std::uint32_t vertex : model_.triangles[triangle].vertices) {
        if (place_[vertex] == kNone) {
          place_[vertex] = static_cast<std::uint32_t>(part.positions.size());
          const Vec3& p = model_.vertices[vertex];
          part.positions.push_back(
              {static_cast<float>(p.x()), static_cast<float>(p.z()), static_cast<float>(-p.y())});
        }
        part.indices.push_back(place_[vertex]);
      }
    }
    for (const std::size_t triangle : triangles) {
      for (const std::uint32_t vertex : model_.triangles[triangle].vertices) place_[vertex] = kNone;
    }
    return part;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  const Model& model_;
  std::vector<std::uint32_t> place_;
};

/// The binary chunk and the tables that describe it.
class GlbBuilder {
 public:
  GlbBuilder() { json_["asset"] = {{"version", "2.0"}, {"generator", "Hallway"}}; }

  void add(const Part& part, const Material& material) {
    const std::size_t positions = add_positions(part.positions);
    const std::size_t indices = add_indices(part.indices);
    primitives_.push_back(
        {{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", materials_.size()}});
    Json description = {
        {"pbrMetallicRoughness",
         {{"baseColorFactor", material.base_colour}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
    if (!material.name.empty()) description["name"] = printable(material.name, kMaxNameBytes);
    if (material.base_colour[3] < 1.0F) description["alphaMode"] = "BLEND";
    description["doubleSided"] = true;
    materials_.push_back(std::move(description));
  }

  std::string finish() {
    if (!primitives_.empty()) {
      json_["scene"] = 0;
      json_["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
      json_["nodes"] = Json::array({{{"mesh", 0}}});
      json_["meshes"] = Json::array({{{"primitives", primitives_}}});
      json_["materials"] = materials_;
      json_["accessors"] = accessors_;
      json_["bufferViews"] = views_;
      json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    }
    return container();
  }

 private:
  std::size_t add_positions(const std::vector<std::array<float, 3>>& positions) {
    std::array<float, 3> low = positions.front();
    std::array<float, 3> high = low;
    for (const auto& position : positions) {
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], position[i]);
        high[i] = std::max(high[i], position[i]);
      }
    }
    accessors_.push_back({{"bufferView", add_view(positions, kArrayBuffer)},
                          {"componentType", kFloat},
                          {"count", positions.size()},
                          {"type", "VEC3"},
                          {"min", low},
                          {"max", high}});
    return accessors_.size() - 1;
  }
  std::size_t add_indices(const std::vector<std::uint32_t>& indices) {
    accessors_.push_back({{"bufferView", add_view(indices, kElementArrayBuffer)},
                          {"componentType", kUnsignedInt},
                          {"count", indices.size()},
                          {"type", "SCALAR"}});
    return accessors_.size() - 1;
  }
  /// Every item is a multiple of four bytes, so that each view begins where it may.
  template <typename T>
  std::size_t add_view(const std::vector<T>& items, int target) {
    const std::size_t bytes = items.size() * sizeof(T);
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}, {"target", target}});
    binary_.append(reinterpret_cast<const char*>(items.data()), bytes);
    return views_.size() - 1;
  }

  std::string container() const {
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t size =
        12 + 8 + std::uint64_t{text.size()} + (binary_.empty() ? 0 : 8 + std::uint64_t{binary_.size()});
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorCode::kBadInput, "the model is too large for a GLB file, which ends at 4 GB");
    std::string glb = "glTF";
    append(glb, std::uint32_t{2});
    append(glb, static_cast<std::uint32_t>(size));
    append(glb, static_cast<std::uint32_t>(text.size()));
    glb += "JSON" + text;
    if (binary_.empty()) return glb;
    append(glb, static_cast<std::uint32_t>(binary_.size()));
    glb += std::string("BIN\0", 4) + binary_;
    return glb;
  }

  Json json_;
  Json primitives_ = Json::array();
  Json materials_ = Json::array();
  Json accessors_ = Json::array();
  Json views_ = Json::array();
  std::string binary_;
};

/// A name that OBJ can hold: one word of it, and no two materials alike.
std::string obj_name(const Material& material, std::size_t index) {
  std::string name = "m" + std::to_string(index);
  if (!material.name.empty()) name += "_" + printable(material.name, kMaxNameBytes);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '\\' || c == '#'; }, '_');
  return name;
}

unsigned char channel_byte(float value) {
  return static_cast<unsigned char>(std::lround(value * static_cast<float>(kMaxChannel)));
}

}  // namespace

std::string to_glb(const Model& model) {
  check_content(model);
  GlbBuilder builder;
  PartMaker parts(model);
  const auto groups = by_material(model);
  for (std::size_t material = 0; material < groups.size(); ++material) {
    if (!groups[material].empty()) builder.add(parts.make(groups[material]), model.materials[material]);
  }
  return builder.finish();
}

ObjFiles to_obj(const Model& model, const std::string& mtl_name) {
  check_content(model);
  ObjFiles files;
  files.obj = "# z up, metres\nmtllib " + mtl_name + "\n";
  files.mtl = "# materials\n";
  for (const Vec3& vertex : model.vertices) {
    files.obj += "v";
    for (const double value : {vertex.x(), vertex.y(), vertex.z()}) {
      files.obj += ' ';
      append_double(files.obj, value);
    }
    files.obj += '\n';
  }
  const auto groups = by_material(model);
  for (std::size_t material = 0; material < groups.size(); ++material) {
    const std::string name = obj_name(model.materials[material], material);
    const auto& [red, green, blue, alpha] = model.materials[material].base_colour;
    files.mtl += "newmtl " + name + "\nKd";
    for (const float channel : {red, green, blue}) files.mtl += " " + format_double(double{channel});
    files.mtl += "\nd " + format_double(double{alpha}) + "\n";
    if (!groups[material].empty()) files.obj += "usemtl " + name + "\n";
    for (const std::size_t triangle : groups[material]) {
      files.obj += "f";
      for (const std::uint32_t vertex : model.triangles[triangle].vertices)
        files.obj += " " + std::to_string(std::uint64_t{vertex} + 1);
      files.obj += '\n';
    }
  }
  return files;
}

std::string to_ply(const Model& model) {
  check_content(model);
  std::string ply = "ply\nformat binary_little_endian 1.0\ncomment z up, metres\nelement vertex " +
                    std::to_string(model.vertices.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(model.triangles.size()) +
                    "\nproperty list uchar uint vertex_indices\nproperty uchar red\nproperty uchar green\n"
                    "property uchar blue\nproperty uchar alpha\nend_header\n";
  for (const Vec3& vertex : model.vertices) {
    for (const double value : {vertex.x(), vertex.y(), vertex.z()}) append(ply, value);
  }
  for (const Triangle& triangle : model.triangles) {
    append(ply, static_cast<unsigned char>(3));
    for (const std::uint32_t vertex : triangle.vertices) append(ply, vertex);
    for (const float channel : model.materials[triangle.material].base_colour)
      append(ply, channel_byte(channel));
  }
  return ply;
}

std::string points_to_ply(std::span<const Vec3> points_m) {
  std::string ply = "ply\nformat binary_little_endian 1.0\ncomment z up, metres\nelement vertex " +
                    std::to_string(points_m.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const Vec3& point : points_m) {
    if (!point.allFinite()) throw Error(ErrorCode::kBadInput, "a point to be written is not finite");
    for (const double value : {point.x(), point.y(), point.z()}) append(ply, value);
  }
  return ply;
}

}  // namespace hallway::mesh
