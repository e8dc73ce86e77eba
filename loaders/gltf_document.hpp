// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "loaders/file_access.hpp"
#include "loaders/scene.hpp"

namespace hallway::loaders::gltf {

/// The parts of a glTF 2.0 document that a model needs, as plain data: what the parser read, unchecked. References are
/// indices, negative where there is none.

struct BufferView {
  std::int64_t buffer = -1;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t stride = 0;  ///< 0: tightly packed
};

/// Values that replace some of an accessor's.
struct Sparse {
  std::int64_t count = 0;
  std::int64_t indices_view = -1;
  std::int64_t indices_offset = 0;
  std::int64_t indices_type = 0;
  std::int64_t values_view = -1;
  std::int64_t values_offset = 0;
};

struct Accessor {
  std::int64_t view = -1;  ///< none: all zero
  std::uint64_t offset = 0;
  std::uint64_t count = 0;
  std::int64_t component_type = 0;  ///< 5120 … 5126, as in the file
  std::int64_t components = 0;      ///< numbers in an element
  bool normalized = false;
  bool is_sparse = false;
  Sparse sparse{};
};

struct Primitive {
  std::map<std::string, std::int64_t> attributes{};  ///< accessors by name
  std::int64_t indices = -1;
  std::int64_t material = -1;
  std::int64_t mode = 4;
};

struct Mesh {
  std::vector<Primitive> primitives{};
};

struct Node {
  std::int64_t mesh = -1;
  std::vector<std::int64_t> children{};
  std::vector<double> matrix{};  ///< 16 numbers by columns, or none
  std::vector<double> translation{};
  std::vector<double> rotation{};
  std::vector<double> scale{};
};

struct Material {
  std::string name{};
  std::vector<double> base_colour{};
  std::int64_t texture = -1;
  std::int64_t texture_set = 0;  ///< the n of TEXCOORD_n
  bool opaque = true;            ///< the alpha of its texture says nothing
};

struct Image {
  std::string name{};
  std::string bytes{};     ///< encoded, where it stood in a file or a data URI
  std::int64_t view = -1;  ///< else
};

struct Document {
  std::vector<std::string> buffers{};
  std::vector<BufferView> views{};
  std::vector<Accessor> accessors{};
  std::vector<Mesh> meshes{};
  std::vector<Node> nodes{};
  std::vector<std::vector<std::int64_t>> scenes{};  ///< root nodes of each
  std::int64_t scene = -1;                          ///< the one to show
  std::vector<Material> materials{};
  std::vector<std::int64_t> textures{};  ///< image of each
  std::vector<Image> images{};
  std::vector<std::string> required_extensions{};
  std::vector<std::string> warnings{};
};

/// True for the bytes of a binary glTF file.
bool is_glb(std::string_view bytes);

/// Checks what the glTF parser relies on: lengths of a GLB header and its chunks within the file, and JSON that is nested no
/// deeper than a recursive parser stands. Throws Error{kBadInput} with the cause.
void check_gltf_container(std::string_view bytes);

/// Parses a `.gltf` or `.glb` file by tinygltf. Files that it names are read through `access`; one that leads outside, or a
/// buffer that is missing, is refused. Throws Error{kBadInput} or Error{kIo}, and whatever tinygltf throws.
Document parse(const std::string& bytes, FileAccess& access);

/// The scene that a document shows: the one it names, else the first, else all nodes that have no parent. Not recursive;
/// nodes must form trees. Morph targets, skins, vertex colours, points and lines are left out. Images that are missing or
/// broken become warnings.
/// Throws Error{kBadInput} naming node, mesh, accessor or image and what is wrong.
Scene convert(const Document& document, const mesh::ModelLimits& limits);

}  // namespace hallway::loaders::gltf
