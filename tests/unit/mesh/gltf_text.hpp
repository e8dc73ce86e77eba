// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::test {

using Json = nlohmann::ordered_json;

inline std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string data_uri(std::string_view bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

/// One triangle (0,0,0) (1,0,0) (0,1,0) of 32-bit floats with 16-bit indices after it, shown by one node.
inline std::string triangle_bytes() {
  return bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) +
         bytes_of(std::vector<std::uint16_t>{0, 1, 2, 0});
}

inline Json triangle_gltf() {
  return Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 44, "uri": ")" +
                     data_uri(triangle_bytes()) + R"("}]})");
}

inline void append_u32(std::string& bytes, std::uint32_t value) {
  char raw[4];
  std::memcpy(raw, &value, 4);
  bytes.append(raw, 4);
}

/// The triangle as a GLB file.
inline std::string triangle_glb() {
  Json json = triangle_gltf();
  json["buffers"][0].erase("uri");
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string binary = triangle_bytes();
  std::string glb = "glTF";
  append_u32(glb, 2);
  append_u32(glb, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  append_u32(glb, static_cast<std::uint32_t>(text.size()));
  glb += "JSON" + text;
  append_u32(glb, static_cast<std::uint32_t>(binary.size()));
  return glb + std::string("BIN\0", 4) + binary;
}

}  // namespace hallway::test
