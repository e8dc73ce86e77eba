// SPDX-License-Identifier: MIT
// hallway-mesh-loader: reads one model file and hands it to the program that started it (engine/mesh/load.hpp).
#include <cstdlib>
#include <exception>
#include <new>

#include "base/error.hpp"
#include "base/helper.hpp"
#include "base/text.hpp"
#include "loaders/assimp_parser.hpp"
#include "loaders/container.hpp"
#include "loaders/file_access.hpp"
#include "loaders/gltf_parser.hpp"
#include "loaders/gltf_scene.hpp"
#include "loaders/scene.hpp"
#include "mesh/protocol.hpp"

namespace {

using hallway::Error;
using hallway::ErrorCode;

constexpr std::uint64_t kMaxRequestBytes = 1 << 20;

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
    if (bytes.empty()) throw Error(ErrorCode::kBadInput, "is empty");
    scene = hallway::loaders::gltf::convert(hallway::loaders::gltf::parse(bytes, access), request.limits);
  } else {
    scene = hallway::loaders::parse_by_assimp(access, request.limits);
  }
  hallway::mesh::Model model = hallway::loaders::flatten(std::move(scene), request.limits);
  model.files = access.files();
  hallway::mesh::check_model(model, request.limits);
  return model;
}

void answer(const Error& failure) {
  hallway::write_standard_output(hallway::mesh::encode_failure(failure));
}

void run() {
  try {
    const auto request = hallway::mesh::decode_request(hallway::read_standard_input(kMaxRequestBytes));
    const hallway::mesh::Model model = load(request);
    hallway::mesh::encode_model(model, hallway::write_standard_output);
  } catch (const Error& failure) {
    answer(failure);
  } catch (const std::bad_alloc&) {
    answer(Error(ErrorCode::kBadInput, "cannot be read: it needs more memory than the mesh loader may use"));
  } catch (const std::exception& failure) {
    answer(Error(ErrorCode::kBadInput, "cannot be read: " + hallway::printable(failure.what(), 500)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !hallway::begin_helper(argv[1])) return 2;
  try {
    run();
  } catch (...) {
    return 3;  // whoever started it no longer reads
  }
  std::_Exit(0);  // nothing to save, and freeing a large scene takes its time
}
