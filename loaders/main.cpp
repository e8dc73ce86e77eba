// SPDX-License-Identifier: MIT
// hallway-mesh-loader: reads one model file and hands it to the program that started it (engine/mesh/load.hpp).
#include "loaders/assimp_parser.hpp"
#include "loaders/gltf_document.hpp"
#include "loaders/helper_main.hpp"
#include "loaders/refuse.hpp"
#include "mesh/protocol.hpp"

namespace {

bool is_gltf(const std::string& name) {
  const auto ends_with = [&](std::string_view end) {
    return name.size() >= end.size() &&
           std::equal(end.begin(), end.end(), name.end() - static_cast<std::ptrdiff_t>(end.size()),
                      [](char a, char b) { return a == (b | ('A' <= b && b <= 'Z' ? 32 : 0)); });
  };
  return ends_with(".gltf") || ends_with(".glb");
}

hallway::mesh::Model load(const hallway::mesh::LoadRequest& request) {
  hallway::loaders::FileAccess access(request.root, request.file, request.limits.file_bytes);
  hallway::loaders::Scene scene;
  if (is_gltf(access.model_name())) {
    const std::string bytes = access.read_model();
    if (bytes.empty()) hallway::loaders::refuse("is empty");
    scene = hallway::loaders::gltf::convert(hallway::loaders::gltf::parse(bytes, access), request.limits);
  } else {
    scene = hallway::loaders::parse_by_assimp(access, request.limits);
  }
  hallway::mesh::Model model = hallway::loaders::flatten(std::move(scene), request.limits);
  model.files = access.files();
  hallway::mesh::check_model(model, request.limits);
  return model;
}

void answer(const std::string& request) {
  hallway::mesh::encode_model(load(hallway::mesh::decode_request(request)), hallway::write_standard_output);
}

}  // namespace

int main(int argc, char** argv) {
  return hallway::loaders::helper_main(argc, argv, "the mesh loader", answer, hallway::mesh::encode_failure);
}
