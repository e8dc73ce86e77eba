// SPDX-License-Identifier: MIT
// The reader of the mesh loader's replies, on any bytes: an Error, or a model that is sound and survives a second trip.
#include "mesh/protocol.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "mesh/export.hpp"

namespace {

constexpr hallway::mesh::ModelLimits kLimits{10'000, 10'000, 1'000, 1'000, 1'000'000, 1'000'000};

std::string encoded(const hallway::mesh::Model& model) {
  std::string message;
  hallway::mesh::encode_model(model, [&](std::string_view bytes) { message.append(bytes); });
  return message;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hallway::mesh::Model model;
  try {
    model = hallway::mesh::decode_reply({reinterpret_cast<const char*>(data), size}, kLimits);
  } catch (const hallway::Error&) {
    return 0;
  }
  hallway::mesh::check_model(
      model, kLimits);  // throws, and so ends the program, if the reader let something through
  const std::string message = encoded(model);
  if (encoded(hallway::mesh::decode_reply(message, kLimits)) != message) std::abort();
  hallway::mesh::to_glb(model);
  hallway::mesh::to_obj(model, "a.mtl");
  hallway::mesh::to_ply(model);
  return 0;
}
