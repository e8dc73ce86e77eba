// SPDX-License-Identifier: MIT
#include "mesh/export.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "image/png.hpp"

namespace hallway::mesh {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kLinear = 9729;
constexpr int kLinearMipmapLinear = 9987;
constexpr int kRepeat = 10497;
constexpr std::size_t kMaxChannel = 255;

/// Every size is fine, but nothing else may be wrong.
void check_content(const Model& model) {
  if (model.triangles.empty()) return;
  constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
  check_model(model, {kAny, kAny, kAny, kAny, kAny, kAny});
}

bool opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] != kMaxChannel) return false;
  }
  return true;
}

/// Without the alpha channel where that says nothing.
std::string png_of(const Image& image) {
  Pixels pixels{image.width, image.height, 4, image.rgba};
  std::vector<std::uint8_t> colours;
  if (opaque(image)) {
    colours.reserve(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
      colours.insert(colours.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
    }
    pixels.channels = 3;
    pixels.bytes = colours;
  }
  return encode_png(pixels, PngEffort::kQuick);
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
  std::vector<std::array<float, 2>> uv;  // one for each position, or none at all
  std::vector<std::uint32_t> indices;
};

/// Numbers the vertices of one part after the other, in time proportional to the part.
class PartMaker {
 public:
  explicit PartMaker(const Model& model) : model_(model), place_(model.vertices.size(), kNone) {}

  Part make(const std::vector<std::size_t>& triangles, bool with_uv) {
    Part part;
    for (const std::size_t triangle : triangles) {
      for (const std::uint32_t vertex : model_.triangles[triangle].vertices) {
        if (place_[vertex] == kNone) {
          place_[vertex] = static_cast<std::uint32_t>(part.positions.size());
          const Vec3& p = model_.vertices[vertex];
          part.positions.push_back(
              {static_cast<float>(p.x()), static_cast<float>(p.z()), static_cast<float>(-p.y())});
          if (with_uv) part.uv.push_back(model_.uv[vertex]);
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

  /// @param image  what the material shows; nullptr for none
  void add(const Part& part, const Material& material, const Image* image) {
    Json attributes = {{"POSITION", add_positions(part.positions)}};
    if (!part.uv.empty()) attributes["TEXCOORD_0"] = add_items(part.uv, kArrayBuffer, kFloat, "VEC2");
    const std::size_t indices = add_items(part.indices, kElementArrayBuffer, kUnsignedInt, "SCALAR");
    primitives_.push_back(
        {{"attributes", attributes}, {"indices", indices}, {"material", materials_.size()}});
    Json surface = {{"baseColorFactor", material.base_colour}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
    if (image != nullptr) surface["baseColorTexture"] = {{"index", texture_of(*image)}};
    Json description = {{"pbrMetallicRoughness", std::move(surface)}};
    if (!material.name.empty()) description["name"] = printable(material.name, kMaxNameBytes);
    if (material.base_colour[3] < 1.0F) {
      description["alphaMode"] = "BLEND";
    } else if (image != nullptr && !opaque(*image)) {
      description["alphaMode"] = "MASK";
    }
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
      if (!textures_.empty()) {
        json_["textures"] = textures_;
        json_["samplers"] = Json::array({{{"magFilter", kLinear},
                                          {"minFilter", kLinearMipmapLinear},
                                          {"wrapS", kRepeat},
                                          {"wrapT", kRepeat}}});
        json_["images"] = images_;
      }
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
    const std::size_t accessor = add_items(positions, kArrayBuffer, kFloat, "VEC3");
    accessors_.back()["min"] = low;
    accessors_.back()["max"] = high;
    return accessor;
  }
  /// Every item is a multiple of four bytes, and images are filled up to one, so that each view begins where it may.
  template <typename T>
  std::size_t add_items(const std::vector<T>& items, int target, int component, const char* type) {
    const std::size_t bytes = items.size() * sizeof(T);
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}, {"target", target}});
    binary_.append(reinterpret_cast<const char*>(items.data()), bytes);
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", component},
                          {"count", items.size()},
                          {"type", type}});
    return accessors_.size() - 1;
  }

  /// The number of the texture that shows an image, which is written when it is first asked for.
  std::size_t texture_of(const Image& image) {
    const auto [found, fresh] = texture_of_.emplace(&image, textures_.size());
    if (!fresh) return found->second;
    const std::string png = png_of(image);
    views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", png.size()}});
    binary_ += png;
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    Json description = {{"bufferView", views_.size() - 1}, {"mimeType", "image/png"}};
    if (!image.name.empty()) description["name"] = printable(image.name, kMaxNameBytes);
    textures_.push_back({{"sampler", 0}, {"source", images_.size()}});
    images_.push_back(std::move(description));
    return found->second;
  }

  std::string container() const {
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t size =
        12 + 8 + std::uint64_t{text.size()} + (binary_.empty() ? 0 : 8 + std::uint64_t{binary_.size()});
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorCode::kBadInput, "the model is too large for a GLB file, which ends at 4 GB");
    std::string glb = "glTF";
    ByteAppender bytes(glb);
    bytes.put(std::uint32_t{2});
    bytes.put(static_cast<std::uint32_t>(size));
    bytes.put(static_cast<std::uint32_t>(text.size()));
    bytes.put_raw("JSON" + text);
    if (binary_.empty()) return glb;
    bytes.put(static_cast<std::uint32_t>(binary_.size()));
    bytes.put_raw({"BIN\0", 4});
    bytes.put_raw(binary_);
    return glb;
  }

  Json json_;
  Json primitives_ = Json::array();
  Json materials_ = Json::array();
  Json accessors_ = Json::array();
  Json views_ = Json::array();
  Json textures_ = Json::array();
  Json images_ = Json::array();
  std::map<const Image*, std::size_t> texture_of_;  // looked up, never walked through
  std::string binary_;
};

/// A name that OBJ can hold: one word of it, and no two materials alike.
std::string obj_name(const Material& material, std::size_t index) {
  std::string name = "m" + std::to_string(index);
  if (!material.name.empty()) name += "_" + printable(material.name, kMaxNameBytes);
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '\\' || c == '#'; }, '_');
  return name;
}

void append_line(std::string& text, const char* keyword, std::initializer_list<double> values) {
  text += keyword;
  for (const double value : values) {
    text += ' ';
    append_double(text, value);
  }
  text += '\n';
}

/// Vertices and texture coordinates, whose v runs up in OBJ.
void append_points(std::string& obj, const Model& model) {
  for (const Vec3& vertex : model.vertices) append_line(obj, "v", {vertex.x(), vertex.y(), vertex.z()});
  for (const auto& [u, v] : model.uv) append_line(obj, "vt", {double{u}, 1.0 - double{v}});
}

/// Adds the images that materials show; gives the file names of all images, empty for others.
std::vector<std::string> add_images(ObjFiles& files, const Model& model, const std::string& mtl_name) {
  std::vector<std::string> names(model.images.size());
  const std::string stem = mtl_name.substr(0, mtl_name.rfind('.'));
  for (const Material& material : model.materials) {
    if (!shows_image(model, material) || !names[*material.image].empty()) continue;
    names[*material.image] = stem + "_" + std::to_string(files.images.size()) + ".png";
    files.images.push_back({names[*material.image], png_of(model.images[*material.image])});
  }
  return names;
}

unsigned char channel_byte(float value) {
  return static_cast<unsigned char>(std::lround(value * static_cast<float>(kMaxChannel)));
}

/// What a PLY file of z-up points begins with, up to the elements after these.
std::string ply_head(std::size_t points) {
  return "ply\nformat binary_little_endian 1.0\ncomment z up, metres\nelement vertex " +
         std::to_string(points) + "\nproperty double x\nproperty double y\nproperty double z\n";
}

}  // namespace

std::string to_glb(const Model& model) {
  check_content(model);
  GlbBuilder builder;
  PartMaker parts(model);
  const auto groups = by_material(model);
  for (std::size_t material = 0; material < groups.size(); ++material) {
    if (groups[material].empty()) continue;
    const Material& look = model.materials[material];
    const Image* image = shows_image(model, look) ? &model.images[*look.image] : nullptr;
    builder.add(parts.make(groups[material], image != nullptr), look, image);
  }
  return builder.finish();
}

ObjFiles to_obj(const Model& model, const std::string& mtl_name) {
  check_content(model);
  ObjFiles files;
  files.obj = "# z up, metres\nmtllib " + mtl_name + "\n";
  files.mtl = "# materials\n";
  append_points(files.obj, model);
  const std::vector<std::string> images = add_images(files, model, mtl_name);
  const auto groups = by_material(model);
  for (std::size_t material = 0; material < groups.size(); ++material) {
    const std::string name = obj_name(model.materials[material], material);
    const auto& [red, green, blue, alpha] = model.materials[material].base_colour;
    files.mtl += "newmtl " + name + "\nKd";
    for (const float channel : {red, green, blue}) files.mtl += " " + format_double(double{channel});
    files.mtl += "\nd " + format_double(double{alpha}) + "\n";
    const bool textured = shows_image(model, model.materials[material]);
    if (textured) files.mtl += "map_Kd " + images[*model.materials[material].image] + "\n";
    if (!groups[material].empty()) files.obj += "usemtl " + name + "\n";
    for (const std::size_t triangle : groups[material]) {
      files.obj += "f";
      for (const std::uint32_t vertex : model.triangles[triangle].vertices) {
        const std::string number = std::to_string(std::uint64_t{vertex} + 1);
        files.obj += " " + number;
        if (textured) files.obj += "/" + number;
      }
      files.obj += '\n';
    }
  }
  return files;
}

std::string to_ply(const Model& model) {
  check_content(model);
  std::string ply = ply_head(model.vertices.size()) + "element face " +
                    std::to_string(model.triangles.size()) +
                    "\nproperty list uchar uint vertex_indices\nproperty uchar red\nproperty uchar green\n"
                    "property uchar blue\nproperty uchar alpha\nend_header\n";
  ByteAppender bytes(ply);
  for (const Vec3& vertex : model.vertices) bytes.put_bytes(vertex.data(), sizeof vertex);
  for (const Triangle& triangle : model.triangles) {
    bytes.put(static_cast<unsigned char>(3));
    bytes.put(triangle.vertices);
    for (const float channel : model.materials[triangle.material].base_colour)
      bytes.put(channel_byte(channel));
  }
  return ply;
}

std::string points_to_ply(std::span<const Vec3> points_m) {
  std::string ply = ply_head(points_m.size()) + "end_header\n";
  ByteAppender bytes(ply);
  for (const Vec3& point : points_m) {
    if (!point.allFinite()) throw Error(ErrorCode::kBadInput, "a point to be written is not finite");
    bytes.put_bytes(point.data(), sizeof point);
  }
  return ply;
}

}  // namespace hallway::mesh
