// SPDX-License-Identifier: MIT
#include "loaders/assimp_parser.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "loaders/image_decoder.hpp"
#include "loaders/refuse.hpp"

namespace hallway::loaders {
namespace {

constexpr std::size_t kMaxWarnings = 100;

/// A file in memory.
class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::string content) : content_(std::move(content)) {}

  std::size_t Read(void* out, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t items = std::min(count, (content_.size() - at_) / size);
    if (items != 0) std::memcpy(out, content_.data() + at_, items * size);
    at_ += items * size;
    return items;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : content_.size();
    // Offsets backwards arrive as huge numbers and wrap around.
    const std::size_t to = from + offset;
    if (to > content_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return content_.size(); }
  void Flush() override {}

 private:
  std::string content_;
  std::size_t at_ = 0;
};

/// Windows paths, as many formats have them, and assimp's own "./".
std::string portable(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name.starts_with("./") ? name.substr(2) : name;
}

/// assimp's way to files, through ours.
class GuardedFiles : public Assimp::IOSystem {
 public:
  GuardedFiles(FileAccess& access, const std::string& model) : access_(access), model_(model) {}

  bool Exists(const char* name) const override { return access_.exists(portable(name)); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (std::strchr(mode, 'r') == nullptr) return nullptr;
    try {
      const std::string path = portable(name);
      return new MemoryStream(path == access_.model_name() ? model_ : access_.read(path));
    } catch (const Error&) {
      return nullptr;  // kept in FileAccess::refused() where it matters
    }
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }
  bool CreateDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

 private:
  FileAccess& access_;
  const std::string& model_;
};

Eigen::Matrix4d matrix_of(const aiMatrix4x4& in) {
  Eigen::Matrix4d out;
  out << double{in.a1}, double{in.a2}, double{in.a3}, double{in.a4},  //
      double{in.b1}, double{in.b2}, double{in.b3}, double{in.b4},     //
      double{in.c1}, double{in.c2}, double{in.c3}, double{in.c4},     //
      0.0, 0.0, 0.0, 1.0;
  return out;
}

std::string lower_extension(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::string extension = dot == std::string::npos ? "" : name.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

/// The number in `<unit … meter="0.0254"/>` of a COLLADA file, which assimp applies and does not hand on.
std::optional<double> collada_unit(std::string_view text) {
  const std::size_t unit = text.find("<unit");
  if (unit == std::string_view::npos) return std::nullopt;
  std::string_view tag = text.substr(unit, text.substr(unit).find('>'));
  const std::size_t meter = tag.find("meter=");
  if (meter == std::string_view::npos) return std::nullopt;
  tag.remove_prefix(meter + std::string_view("meter=").size());
  if (tag.empty()) return std::nullopt;
  const std::size_t end = tag.find(tag.front(), 1);
  if (end == std::string_view::npos) return std::nullopt;
  const auto value = parse_double(trim(tag.substr(1, end - 1)));
  return value && *value > 0.0 ? value : std::nullopt;
}

class Converter {
 public:
  Converter(const aiScene& from, FileAccess& access, const mesh::ModelLimits& limits)
      : from_(from), access_(access), limits_(limits), decoder_(limits.image_bytes) {}

  Scene run() {
    if (from_.mNumMaterials > limits_.materials) refuse("has too many materials");
    for (unsigned i = 0; i < from_.mNumMaterials; ++i) add_material(*from_.mMaterials[i]);
    if (scene_.materials.empty()) scene_.materials.push_back({.name = "default"});
    check_sizes();
    for (unsigned i = 0; i < from_.mNumMeshes; ++i) scene_.parts.push_back(part_of(*from_.mMeshes[i]));
    if (left_out_ > 0) warn(std::to_string(left_out_) + " points and lines are left out");
    walk();
    for (const std::string& name : access_.refused()) warn(name);
    return std::move(scene_);
  }

 private:
  void check_sizes() const {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    for (unsigned i = 0; i < from_.mNumMeshes; ++i) {
      vertices += from_.mMeshes[i]->mNumVertices;
      triangles += from_.mMeshes[i]->mNumFaces;
    }
    if (vertices > limits_.vertices || triangles > limits_.triangles)
      refuse("has more triangles than the limit");
  }

  /// A part without vertices where the mesh has no triangles.
  MeshPart part_of(const aiMesh& mesh) {
    MeshPart part;
    part.material = mesh.mMaterialIndex;
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) {
      left_out_ += mesh.mNumFaces;
      return part;
    }
    part.positions.reserve(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      part.positions.push_back({p.x, p.y, p.z});
    }
    if (mesh.HasTextureCoords(0)) {
      part.uv.reserve(mesh.mNumVertices);
      for (unsigned i = 0; i < mesh.mNumVertices; ++i)
        part.uv.push_back({mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y});
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices == 3) {
        part.indices.insert(part.indices.end(), face.mIndices, face.mIndices + 3);
      } else {
        ++left_out_;
      }
    }
    return part;
  }

  void walk() {
    std::vector<std::pair<const aiNode*, Eigen::Matrix4d>> stack;
    if (from_.mRootNode != nullptr) stack.emplace_back(from_.mRootNode, Eigen::Matrix4d::Identity());
    while (!stack.empty()) {
      const auto [node, parent] = stack.back();
      stack.pop_back();
      const Eigen::Matrix4d transform = parent * matrix_of(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) scene_.placed.push_back({node->mMeshes[i], transform});
      for (unsigned i = node->mNumChildren; i-- > 0;) stack.emplace_back(node->mChildren[i], transform);
    }
  }

  void add_material(const aiMaterial& from) {
    mesh::Material material;
    aiString name;
    if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) material.name = name.C_Str();
    aiColor4D colour(1.0F, 1.0F, 1.0F, 1.0F);
    if (from.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    aiString texture;
    const bool textured = from.GetTexture(aiTextureType_BASE_COLOR, 0, &texture) == aiReturn_SUCCESS ||
                          from.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == aiReturn_SUCCESS;
    if (textured) material.image = image_named(texture.C_Str());
    material.base_colour = {colour.r, colour.g, colour.b, colour.a};
    scene_.materials.push_back(std::move(material));
  }

  std::optional<std::uint32_t> image_named(const std::string& name) {
    const auto [found, fresh] = images_.try_emplace(name);
    if (!fresh) return found->second;
    const aiTexture* embedded = from_.GetEmbeddedTexture(name.c_str());
    if (embedded != nullptr && embedded->mHeight != 0) {
      found->second = keep(raw_image(*embedded, name));
      return found->second;
    }
    try {
      const std::string bytes =
          embedded != nullptr ? std::string(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth)
                              : access_.read(portable(name));
      auto result = decoder_.decode(bytes, name);
      if (const auto* why = std::get_if<std::string>(&result)) {
        warn("the image " + printable(name) + " " + *why);
      } else {
        found->second = keep(std::move(std::get<mesh::Image>(result)));
      }
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kIo) throw;  // over the limits
      warn("the image " + printable(name) + " " + error.message());
    }
    return found->second;
  }

  mesh::Image raw_image(const aiTexture& from, const std::string& name) {
    decoder_.reserve(from.mWidth, from.mHeight, name);
    mesh::Image image{name, from.mWidth, from.mHeight, {}};
    const std::size_t pixels = std::size_t{from.mWidth} * from.mHeight;
    image.rgba.reserve(4 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const aiTexel& texel = from.pcData[i];
      image.rgba.insert(image.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
    }
    return image;
  }

  std::uint32_t keep(mesh::Image image) {
    if (scene_.images.size() >= limits_.images) refuse("has more images than the limit");
    scene_.images.push_back(std::move(image));
    return static_cast<std::uint32_t>(scene_.images.size() - 1);
  }

  void warn(const std::string& text) {
    if (scene_.warnings.size() < kMaxWarnings && warned_.insert(text).second) scene_.warnings.push_back(text);
  }

  const aiScene& from_;
  FileAccess& access_;
  mesh::ModelLimits limits_;
  ImageDecoder decoder_;
  std::map<std::string, std::optional<std::uint32_t>> images_;
  std::set<std::string> warned_;
  std::uint64_t left_out_ = 0;  ///< faces that are no triangles
  Scene scene_;
};

/// The axis that the metadata name, times its sign and `direction`; zero where they name none.
Eigen::RowVector3d named_axis(const aiMetadata& from, const std::string& name, double direction) {
  Eigen::RowVector3d result = Eigen::RowVector3d::Zero();
  std::int32_t axis = -1;
  std::int32_t sign = 1;
  from.Get(name, axis);
  from.Get(name + "Sign", sign);
  if (axis >= 0 && axis <= 2) result[axis] = sign < 0 ? -direction : direction;
  return result;
}

/// FBX names the axes that point right, up and towards the viewer; assimp hands them on and leaves the rest to us.
Eigen::Matrix3d fbx_axes(const aiMetadata& from) {
  Eigen::Matrix3d axes;
  axes << named_axis(from, "CoordAxis", 1.0), named_axis(from, "FrontAxis", -1.0),
      named_axis(from, "UpAxis", 1.0);
  return axes.determinant() > 0.5 ? axes : y_up_to_z_up();
}

/// Metres in a unit; FBX counts in centimetres.
double fbx_unit(const aiMetadata& from) {
  double centimetres = 1.0;
  float less_exact = 1.0F;
  if (!from.Get("UnitScaleFactor", centimetres) && from.Get("UnitScaleFactor", less_exact)) {
    centimetres = double{less_exact};
  }
  return centimetres > 0.0 ? centimetres / 100.0 : 0.01;
}

/// Undoes what assimp did about the axes of FBX. The root of its tree is nothing of the file: up to 5.3 it is the identity, later ones turn the whole by it, and
/// whether the unit is in it, too, depends on the version.
Eigen::Matrix3d fbx_root_undone(const aiNode& root) {
  const aiMatrix4x4& m = root.mTransformation;
  Eigen::Matrix3d turned;
  turned << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
  return std::abs(turned.determinant()) > 1e-12 ? turned.inverse().eval() : Eigen::Matrix3d::Identity();
}

/// Sets axes and units by what the format says about itself.
void set_frame(Scene& scene, const std::string& extension, const aiScene& from, const std::string& bytes) {
  static const std::set<std::string> kAsTheyStand{"obj", "stl", "ply", "off"};
  if (!kAsTheyStand.contains(extension)) scene.to_world = y_up_to_z_up();
  if (extension == "dae") scene.metres_per_unit = collada_unit(bytes).value_or(1.0);
  if (extension != "fbx" || from.mMetaData == nullptr) return;
  scene.metres_per_unit = fbx_unit(*from.mMetaData);
  scene.to_world = scene.metres_per_unit * fbx_axes(*from.mMetaData) * fbx_root_undone(*from.mRootNode);
}

}  // namespace

Scene parse_by_assimp(FileAccess& access, const mesh::ModelLimits& limits) {
  const std::string bytes = access.read_model();
  if (bytes.empty()) refuse("is empty");
  Assimp::Importer importer;
  importer.SetIOHandler(new GuardedFiles(access, bytes));  // which deletes it
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = importer.ReadFile(access.model_name(),
                                           aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_FlipUVs);
  if (scene == nullptr) refuse("cannot be read: " + printable(trim(importer.GetErrorString()), 500));
  Scene result = Converter(*scene, access, limits).run();
  set_frame(result, lower_extension(access.model_name()), *scene, bytes);
  return result;
}

}  // namespace hallway::loaders
