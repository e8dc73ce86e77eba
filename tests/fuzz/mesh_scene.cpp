// SPDX-License-Identifier: MIT
// Our conversion of what the third-party parsers hand over, on documents and scenes in which any number may be anything: an
// Error, or a model that is sound but for vertices too far away.
#include "loaders/scene.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "fuzz/mesh_bytes.hpp"
#include "loaders/gltf_document.hpp"

namespace {

using hallway::fuzz::ByteSource;
namespace gltf = hallway::loaders::gltf;
namespace loaders = hallway::loaders;
namespace mesh = hallway::mesh;

constexpr mesh::ModelLimits kLimits{2'000, 3'000, 100, 100, 100'000, 100'000};

std::vector<double> reals(ByteSource& from, std::size_t usual) {
  const std::size_t choice = from.count(7);
  std::vector<double> numbers(choice < 4 ? 0 : choice < 7 ? usual : from.count(20));
  for (double& number : numbers) number = from.real();
  return numbers;
}

gltf::Accessor accessor(ByteSource& from) {
  gltf::Accessor result;
  result.view = from.index();
  result.offset = from.whole();
  result.count = from.whole();
  result.component_type = 5119 + static_cast<std::int64_t>(from.count(8));
  result.components = static_cast<std::int64_t>(from.count(4));
  result.normalized = from.flag();
  result.is_sparse = from.flag();
  if (result.is_sparse) {
    result.sparse = {from.index(), from.index(),
                     from.index(), 5119 + static_cast<std::int64_t>(from.count(8)),
                     from.index(), from.index()};
  }
  return result;
}

gltf::Primitive primitive(ByteSource& from) {
  gltf::Primitive result;
  if (from.count(15) != 0) result.attributes["POSITION"] = from.index();
  if (from.flag()) result.attributes["TEXCOORD_0"] = from.index();
  result.indices = from.index();
  result.material = from.index();
  result.mode = from.index();
  return result;
}

gltf::Node node(ByteSource& from) {
  gltf::Node result;
  result.mesh = from.index();
  result.children.resize(from.count(3));
  for (std::int64_t& child : result.children) child = from.index();
  result.matrix = reals(from, 16);
  result.translation = reals(from, 3);
  result.rotation = reals(from, 4);
  result.scale = reals(from, 3);
  return result;
}

gltf::Document document(ByteSource& from) {
  gltf::Document result;
  for (std::size_t i = from.count(3); i-- > 0;) result.buffers.push_back(from.text(200));
  for (std::size_t i = from.count(4); i-- > 0;)
    result.views.push_back({from.index(), from.whole(), from.whole(), from.whole()});
  for (std::size_t i = from.count(4); i-- > 0;) result.accessors.push_back(accessor(from));
  for (std::size_t i = from.count(3); i-- > 0;) {
    gltf::Mesh mesh;
    for (std::size_t k = from.count(3); k-- > 0;) mesh.primitives.push_back(primitive(from));
    result.meshes.push_back(mesh);
  }
  for (std::size_t i = from.count(5); i-- > 0;) result.nodes.push_back(node(from));
  for (std::size_t i = from.count(2); i-- > 0;) {
    std::vector<std::int64_t> roots(from.count(3));
    for (std::int64_t& root : roots) root = from.index();
    result.scenes.push_back(roots);
  }
  result.scene = from.index();
  for (std::size_t i = from.count(3); i-- > 0;)
    result.materials.push_back({from.text(4), reals(from, 4), from.index(), from.index()});
  for (std::size_t i = from.count(3); i-- > 0;) result.textures.push_back(from.index());
  for (std::size_t i = from.count(3); i-- > 0;)
    result.images.push_back({from.text(4), from.text(100), from.index()});
  return result;
}

loaders::MeshPart part(ByteSource& from) {
  loaders::MeshPart result;
  result.positions.resize(from.count(12));
  for (auto& position : result.positions)
    position = {from.real_float(), from.real_float(), from.real_float()};
  if (from.flag()) result.uv.resize(from.flag() ? result.positions.size() : from.count(12));
  for (auto& uv : result.uv) uv = {from.real_float(), from.real_float()};
  result.indices.resize(from.count(24));
  for (std::uint32_t& index : result.indices) index = static_cast<std::uint32_t>(from.whole());
  result.material = static_cast<std::uint32_t>(from.whole());
  return result;
}

loaders::Scene scene(ByteSource& from) {
  loaders::Scene result;
  for (std::size_t i = from.count(3); i-- > 0;) result.parts.push_back(part(from));
  for (std::size_t i = from.count(4); i-- > 0;) {
    loaders::PlacedPart placed;
    placed.part = static_cast<std::uint32_t>(from.whole());
    for (int k = 0; k < 16; ++k) placed.transform(k / 4, k % 4) = from.real();
    result.placed.push_back(placed);
  }
  for (std::size_t i = from.count(3); i-- > 0;) {
    mesh::Material material;
    for (float& channel : material.base_colour) channel = from.real_float();
    if (from.flag()) material.image = static_cast<std::uint32_t>(from.whole());
    result.materials.push_back(material);
  }
  for (std::size_t i = from.count(2); i-- > 0;) result.images.push_back({"i", 1, 1, {1, 2, 3, 4}});
  result.to_world = loaders::y_up_to_z_up();
  return result;
}

/// Indices, sizes and colours must be right; only numbers that are no good, and what a parser itself puts together (images),
/// are left to check_model().
void check_flat(const mesh::Model& model) {
  for (const mesh::Triangle& triangle : model.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) {
      if (vertex >= model.vertices.size()) std::abort();
    }
    if (triangle.material >= model.materials.size()) std::abort();
  }
  if (!model.uv.empty() && model.uv.size() != model.vertices.size()) std::abort();
  if (model.vertices.size() > kLimits.vertices || model.triangles.size() > kLimits.triangles) std::abort();
  try {
    mesh::check_model(model, kLimits);
  } catch (const hallway::Error&) {
    return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    ByteSource from(bytes);
    switch (from.count(2)) {
      case 0:
        gltf::check_gltf_container(bytes.substr(std::min<std::size_t>(1, bytes.size())));
        break;
      case 1:
        check_flat(loaders::flatten(scene(from), kLimits));
        break;
      default:
        check_flat(loaders::flatten(gltf::convert(document(from), kLimits), kLimits));
    }
  } catch (const hallway::Error&) {
  }
  return 0;
}
