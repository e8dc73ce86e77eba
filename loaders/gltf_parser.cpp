// SPDX-License-Identifier: MIT
#include "loaders/gltf_document.hpp"

#include <tiny_gltf.h>

#include <limits>
#include <string_view>
#include <utility>

#include "base/text.hpp"
#include "loaders/refuse.hpp"

namespace hallway::loaders::gltf {
namespace {

/// tinygltf joins names with "." and the empty folder.
std::string without_dot(const std::string& name) {
  return name.starts_with("./") ? name.substr(2) : name;
}

FileAccess& access_of(void* user) {
  return *static_cast<FileAccess*>(user);
}

/// True for a name that is refused, too: reading it then says why.
bool file_exists(const std::string& name, void*) {
  return !name.empty();
}

std::string keep_path(const std::string& name, void*) {
  return name;
}

bool read_file(std::vector<unsigned char>* out, std::string* message, const std::string& name, void* user) {
  try {
    const std::string bytes = access_of(user).read(without_dot(name));
    out->assign(bytes.begin(), bytes.end());
    return true;
  } catch (const Error& error) {
    if (message != nullptr) *message += error.what();
    return false;
  }
}

/// What FileAccess reads it limits itself. Before tinygltf 2.9 nothing asks.
[[maybe_unused]] bool file_size_unknown(std::size_t* size, std::string*, const std::string&, void*) {
  *size = 0;
  return true;
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

/// The only way to files that the parser gets. `Callbacks` is tinygltf::FsCallbacks; from 2.9 on it has one more, and none may be missing.
template <typename Callbacks>
Callbacks callbacks_for(FileAccess& access) {
  Callbacks callbacks{};
  callbacks.FileExists = &file_exists;
  callbacks.ExpandFilePath = &keep_path;
  callbacks.ReadWholeFile = &read_file;
  callbacks.WriteWholeFile = &write_nothing;
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) callbacks.GetFileSizeInBytes = &file_size_unknown;
  callbacks.user_data = &access;
  return callbacks;
}

/// Keeps the encoded bytes; decoding comes later and only for what is shown. The range of a buffer view is not checked
/// here by tinygltf, so those bytes are not even looked at.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                int size, void*) {
  image->as_is = true;
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// tinygltf's messages, in one line.
std::string one_line(std::string_view message) {
  std::string text;
  for (const std::string_view line : split(message, '\n')) {
    if (!trim(line).empty()) text += (text.empty() ? "" : "; ") + std::string(trim(line));
  }
  return printable(text, 500);
}

std::vector<std::int64_t> widened(const std::vector<int>& numbers) {
  return {numbers.begin(), numbers.end()};
}

Accessor accessor_of(const tinygltf::Accessor& in) {
  Accessor out;
  out.view = in.bufferView;
  out.offset = in.byteOffset;
  out.count = in.count;
  out.component_type = in.componentType;
  out.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(in.type));
  out.normalized = in.normalized;
  out.is_sparse = in.sparse.isSparse;
  if (out.is_sparse) {
    // Some versions have whole numbers with a sign here; what is then below 0 the reader of the document refuses.
    out.sparse = {in.sparse.count,
                  in.sparse.indices.bufferView,
                  static_cast<std::int64_t>(in.sparse.indices.byteOffset),
                  in.sparse.indices.componentType,
                  in.sparse.values.bufferView,
                  static_cast<std::int64_t>(in.sparse.values.byteOffset)};
  }
  return out;
}

Mesh mesh_of(const tinygltf::Mesh& in) {
  Mesh out;
  for (const tinygltf::Primitive& primitive : in.primitives) {
    Primitive converted;
    for (const auto& [name, accessor] : primitive.attributes) converted.attributes[name] = accessor;
    converted.indices = primitive.indices;
    converted.material = primitive.material;
    converted.mode = primitive.mode;
    out.primitives.push_back(std::move(converted));
  }
  return out;
}

Material material_of(const tinygltf::Material& in) {
  const tinygltf::PbrMetallicRoughness& pbr = in.pbrMetallicRoughness;
  const bool opaque = in.alphaMode != "MASK" && in.alphaMode != "BLEND";
  return {in.name, pbr.baseColorFactor, pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord, opaque};
}

Image image_of(tinygltf::Image& in) {
  Image out;
  out.name = !in.name.empty() ? in.name : in.uri;
  out.bytes.assign(in.image.begin(), in.image.end());
  out.view = in.bufferView;
  return out;
}

Document document_of(tinygltf::Model& model) {
  Document out;
  for (tinygltf::Buffer& buffer : model.buffers) {
    out.buffers.emplace_back(buffer.data.begin(), buffer.data.end());
    std::vector<unsigned char>().swap(buffer.data);
  }
  for (const tinygltf::BufferView& view : model.bufferViews)
    out.views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride});
  for (const tinygltf::Accessor& accessor : model.accessors) out.accessors.push_back(accessor_of(accessor));
  for (const tinygltf::Mesh& mesh : model.meshes) out.meshes.push_back(mesh_of(mesh));
  for (tinygltf::Node& node : model.nodes) {
    out.nodes.push_back({node.mesh, widened(node.children), std::move(node.matrix),
                         std::move(node.translation), std::move(node.rotation), std::move(node.scale)});
  }
  for (const tinygltf::Scene& scene : model.scenes) out.scenes.push_back(widened(scene.nodes));
  out.scene = model.defaultScene;
  for (const tinygltf::Material& material : model.materials) out.materials.push_back(material_of(material));
  for (const tinygltf::Texture& texture : model.textures) out.textures.push_back(texture.source);
  for (tinygltf::Image& image : model.images) out.images.push_back(image_of(image));
  out.required_extensions = model.extensionsRequired;
  return out;
}

}  // namespace

Document parse(const std::string& bytes, FileAccess& access) {
  if (bytes.size() > std::numeric_limits<unsigned>::max()) refuse("is larger than 4 GB");
  check_gltf_container(bytes);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks(callbacks_for<tinygltf::FsCallbacks>(access));
  parser.SetImageLoader(&keep_image, nullptr);
  tinygltf::Model model;
  std::string message;
  std::string warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const bool good =
      is_glb(bytes) ? parser.LoadBinaryFromMemory(&model, &message, &warning,
                                                  reinterpret_cast<const unsigned char*>(bytes.data()), size)
                    : parser.LoadASCIIFromString(&model, &message, &warning, bytes.data(), size, "");
  if (!access.refused().empty()) refuse(access.refused().front());
  if (!good) refuse("is no glTF file that can be read: " + one_line(message));
  return document_of(model);
}

}  // namespace hallway::loaders::gltf
