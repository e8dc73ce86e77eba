// SPDX-License-Identifier: MIT
#include "loaders/gltf_document.hpp"

#include <cstdint>
#include <cstring>
#include <string>

#include "loaders/refuse.hpp"

namespace hallway::loaders::gltf {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr int kMaxDepth = 256;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

void check_depth(std::string_view json) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth)
        refuse("its JSON is nested deeper than " + std::to_string(kMaxDepth) + " levels");
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

/// @return the JSON chunk
std::string_view check_glb(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
    refuse("is cut short: a GLB file has a header and a chunk");
  const std::uint32_t version = number_at(bytes, 4);
  if (version != 2) refuse("is a GLB file of version " + std::to_string(version) + "; version 2 is read");
  const std::uint32_t length = number_at(bytes, 8);
  if (length != bytes.size()) {
    refuse("says that it has " + std::to_string(length) + " bytes, and has " + std::to_string(bytes.size()));
  }
  std::size_t at = kHeaderBytes;
  std::string_view json;
  while (at < bytes.size()) {
    if (bytes.size() - at < kChunkHeaderBytes) refuse("is cut short in the header of a chunk");
    const std::size_t size = number_at(bytes, at);
    const bool first = at == kHeaderBytes;
    if (first && number_at(bytes, at + 4) != kJsonChunk) refuse("its first chunk is not JSON");
    at += kChunkHeaderBytes;
    if (size > bytes.size() - at) {
      refuse("a chunk of " + std::to_string(size) + " bytes reaches beyond the end of the file");
    }
    if (first) json = bytes.substr(at, size);
    at += size;
  }
  return json;
}

}  // namespace

bool is_glb(std::string_view bytes) {
  return bytes.starts_with(kMagic);
}

void check_gltf_container(std::string_view bytes) {
  check_depth(is_glb(bytes) ? check_glb(bytes) : bytes);
}

}  // namespace hallway::loaders::gltf
