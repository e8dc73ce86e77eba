// SPDX-License-Identifier: MIT
#include "loaders/gltf_document.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "loaders/gltf_accessor.hpp"
#include "loaders/image_decoder.hpp"
#include "loaders/refuse.hpp"

namespace hallway::loaders::gltf {
namespace {

constexpr std::int64_t kTriangles = 4;
constexpr std::int64_t kStrip = 5;
constexpr std::int64_t kFan = 6;

template <typename T>
const T& at(const std::vector<T>& items, std::int64_t index, const char* what) {
  if (index < 0 || static_cast<std::uint64_t>(index) >= items.size())
    refuse("there is no " + std::string(what) + " " + std::to_string(index));
  return items[static_cast<std::size_t>(index)];
}

/// Extensions without which the shape would be another one are refused where a file requires them.
void check_extensions(const Document& document) {
  for (const std::string& name : document.required_extensions) {
    const bool known = name == "KHR_mesh_quantization" || name == "KHR_texture_transform" ||
                       name == "KHR_lights_punctual" || name.starts_with("KHR_materials_");
    if (!known) refuse("requires the glTF extension " + printable(name) + ", which is not read");
  }
}

Eigen::Vector3d vector_of(const std::vector<double>& numbers, const Eigen::Vector3d& fallback,
                          const char* what) {
  if (numbers.empty()) return fallback;
  if (numbers.size() != 3) refuse("its " + std::string(what) + " is not three numbers");
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Matrix4d local_transform(const Node& node) {
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  if (!node.matrix.empty()) {
    if (node.matrix.size() != 16) refuse("its matrix is not 16 numbers");
    transform = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    transform.row(3) = Eigen::RowVector4d::UnitW();  // the format allows no other
  } else {
    const Eigen::Vector3d scale = vector_of(node.scale, Eigen::Vector3d::Ones(), "scale");
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    if (!node.rotation.empty()) {
      if (node.rotation.size() != 4) refuse("its rotation is not four numbers");
      q = Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
      if (!(q.norm() > 0.0)) refuse("its rotation is no quaternion");
      q.normalize();
    }
    transform.topLeftCorner<3, 3>() = q.toRotationMatrix() * scale.asDiagonal();
    transform.topRightCorner<3, 1>() = vector_of(node.translation, Eigen::Vector3d::Zero(), "translation");
  }
  if (!transform.allFinite()) refuse("its transform is not finite");
  return transform;
}

constexpr std::size_t kAlpha = 3;  // of four channels
constexpr std::uint8_t kOpaque = 255;

bool has_alpha(const mesh::Image& image) {
  for (std::size_t i = kAlpha; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] != kOpaque) return true;
  }
  return false;
}

void remove_alpha(mesh::Image& image) {
  for (std::size_t i = kAlpha; i < image.rgba.size(); i += 4) image.rgba[i] = kOpaque;
}

/// Indices of separate triangles from those of a strip or fan.
std::vector<std::uint32_t> unroll(const std::vector<std::uint32_t>& run, std::int64_t mode) {
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 0; i + 2 < run.size(); ++i) {
    if (mode == kStrip) {
      triangles.insert(triangles.end(), {run[i], run[i + 1 + i % 2], run[i + 2 - i % 2]});
    } else {
      triangles.insert(triangles.end(), {run[i + 1], run[i + 2], run[0]});
    }
  }
  return triangles;
}

class Converter {
 public:
  Converter(const Document& document, const mesh::ModelLimits& limits)
      : document_(document),
        accessors_(document),
        limits_(limits),
        decoder_(limits.image_bytes),
        vertices_left_(limits.vertices),
        triangles_left_(limits.triangles),
        parts_of_mesh_(document.meshes.size()),
        image_of_(document.images.size()) {}

  Scene run() {
    check_extensions(document_);
    scene_.to_world = y_up_to_z_up();
    scene_.warnings = document_.warnings;
    if (document_.materials.size() > limits_.materials) refuse("has too many materials");
    for (const Material& material : document_.materials) add_material(material);
    walk(roots());
    return std::move(scene_);
  }

 private:
  std::vector<std::int64_t> roots() const {
    if (document_.scene >= 0) return at(document_.scenes, document_.scene, "scene");
    if (!document_.scenes.empty()) return document_.scenes.front();
    std::vector<bool> has_parent(document_.nodes.size());
    for (const Node& node : document_.nodes) {
      for (const std::int64_t child : node.children) {
        if (child >= 0 && static_cast<std::uint64_t>(child) < has_parent.size())
          has_parent[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<std::int64_t> found;
    for (std::size_t i = 0; i < has_parent.size(); ++i) {
      if (!has_parent[i]) found.push_back(static_cast<std::int64_t>(i));
    }
    return found;
  }

  void walk(const std::vector<std::int64_t>& roots) {
    struct Visit {
      std::int64_t node;
      Eigen::Matrix4d parent;
    };
    std::vector<Visit> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
      stack.push_back({*root, Eigen::Matrix4d::Identity()});
    std::vector<bool> seen(document_.nodes.size());
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const Node& node = at(document_.nodes, visit.node, "node");
      const std::string name = "node " + std::to_string(visit.node);
      if (seen[static_cast<std::size_t>(visit.node)]) refuse("is reached twice; nodes must form trees", name);
      seen[static_cast<std::size_t>(visit.node)] = true;
      try {
        const Eigen::Matrix4d transform = visit.parent * local_transform(node);
        if (node.mesh >= 0) place(node.mesh, transform);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
          stack.push_back({*child, transform});
      } catch (const Error& error) {
        const std::string& element = error.where().element;
        refuse(error.message(), name + (element.empty() ? "" : ", " + element));
      }
    }
  }

  void place(std::int64_t mesh, const Eigen::Matrix4d& transform) {
    const Mesh& found = at(document_.meshes, mesh, "mesh");
    auto& parts = parts_of_mesh_[static_cast<std::size_t>(mesh)];
    if (!parts) {
      parts.emplace();
      for (std::size_t i = 0; i < found.primitives.size(); ++i) {
        if (auto part = convert_primitive(found.primitives[i], mesh)) {
          parts->push_back(static_cast<std::uint32_t>(scene_.parts.size()));
          scene_.parts.push_back(std::move(*part));
        }
      }
    }
    for (const std::uint32_t part : *parts) scene_.placed.push_back({part, transform});
  }

  std::optional<MeshPart> convert_primitive(const Primitive& primitive, std::int64_t mesh) {
    if (primitive.mode < 0 || primitive.mode > kFan)
      refuse("primitive mode " + std::to_string(primitive.mode) + " is none of glTF's");
    const auto position = primitive.attributes.find("POSITION");
    if (primitive.mode < kTriangles || position == primitive.attributes.end()) {
      warn("mesh " + std::to_string(mesh) +
           ": a primitive of points or lines, or without positions, is left out");
      return std::nullopt;
    }
    MeshPart part;
    part.material = primitive.material >= 0 ? known_material(primitive.material) : default_material();
    part.positions = accessors_.vectors3(position->second, vertices_left_);
    vertices_left_ -= part.positions.size();
    part.indices = indices_of(primitive, part.positions.size());
    triangles_left_ -= std::min<std::uint64_t>(triangles_left_, part.indices.size() / 3);
    add_uv(primitive, part);
    return part;
  }

  std::vector<std::uint32_t> indices_of(const Primitive& primitive, std::size_t vertices) const {
    const std::uint64_t most = primitive.mode == kTriangles ? 3 * triangles_left_ : triangles_left_ + 2;
    std::vector<std::uint32_t> run;
    if (primitive.indices >= 0) {
      run = accessors_.indices(primitive.indices, most);
    } else {
      if (vertices > most) refuse("has more triangles than the limit");
      run.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) run[i] = static_cast<std::uint32_t>(i);
    }
    return primitive.mode == kTriangles ? run : unroll(run, primitive.mode);
  }

  void add_uv(const Primitive& primitive, MeshPart& part) const {
    if (!scene_.materials[part.material].image) return;
    const Material& material = document_.materials[part.material];
    const auto uv = primitive.attributes.find("TEXCOORD_" + std::to_string(material.texture_set));
    if (uv != primitive.attributes.end()) part.uv = accessors_.vectors2(uv->second, part.positions.size());
  }

  std::uint32_t known_material(std::int64_t material) const {
    at(document_.materials, material, "material");
    return static_cast<std::uint32_t>(material);
  }

  /// Materials of the document keep their indices, so this one stands after them.
  std::uint32_t default_material() {
    if (scene_.materials.size() == document_.materials.size())
      scene_.materials.push_back({.name = "default"});
    return static_cast<std::uint32_t>(document_.materials.size());
  }

  void add_material(const Material& material) {
    mesh::Material result{.name = material.name};
    if (material.base_colour.size() == 4) {
      std::transform(material.base_colour.begin(), material.base_colour.end(), result.base_colour.begin(),
                     [](double value) { return static_cast<float>(value); });
    }
    if (material.texture >= 0) {
      const std::int64_t image = at(document_.textures, material.texture, "texture");
      if (image >= 0) result.image = decoded(image, material.opaque);
    }
    scene_.materials.push_back(std::move(result));
  }

  /// An image whose alpha counts for one material and not for another becomes two.
  std::optional<std::uint32_t> decoded(std::int64_t image, bool opaque) {
    const Image& found = at(document_.images, image, "image");
    auto& both = image_of_[static_cast<std::size_t>(image)];
    auto& done = both[opaque ? 1 : 0];
    if (done) return *done;
    done.emplace();
    const std::string name = found.name.empty() ? "image " + std::to_string(image) : found.name;
    const std::string_view bytes =
        found.view >= 0 ? accessors_.view_bytes(found.view) : std::string_view(found.bytes);
    if (bytes.empty()) {
      warn("the image " + printable(name) + " is missing");
      return std::nullopt;
    }
    auto result = decoder_.decode(bytes, name);
    if (const auto* why = std::get_if<std::string>(&result)) {
      warn("the image " + printable(name) + " " + *why);
      return std::nullopt;
    }
    if (scene_.images.size() >= limits_.images) refuse("has more images than the limit");
    *done = static_cast<std::uint32_t>(scene_.images.size());
    scene_.images.push_back(std::move(std::get<mesh::Image>(result)));
    if (!has_alpha(scene_.images.back())) {
      both.fill(done);
    } else if (opaque) {
      remove_alpha(scene_.images.back());
    }
    return *done;
  }

  void warn(const std::string& text) {
    if (warned_.insert(text).second && warned_.size() < 100) scene_.warnings.push_back(text);
  }

  const Document& document_;
  AccessorReader accessors_;
  mesh::ModelLimits limits_;
  ImageDecoder decoder_;
  std::uint64_t vertices_left_;
  std::uint64_t triangles_left_;
  std::vector<std::optional<std::vector<std::uint32_t>>> parts_of_mesh_;  ///< empty: not converted yet
  /// With its alpha, and without; empty: not decoded yet.
  std::vector<std::array<std::optional<std::optional<std::uint32_t>>, 2>> image_of_;
  std::set<std::string> warned_;
  Scene scene_;
};

}  // namespace

Scene convert(const Document& document, const mesh::ModelLimits& limits) {
  return Converter(document, limits).run();
}

}  // namespace hallway::loaders::gltf
