// SPDX-License-Identifier: MIT
//
// OSMesa is declared here as far as it is used: Mesa has no header of it any more from version 25.1 on.
#include <array>
#include <cstdint>

#include "render/gl_context.hpp"
#include "render/gl_library.hpp"

namespace hallway::render {
namespace {

constexpr std::array<const char*, 3> kFiles{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
constexpr GlLibraryNames kLibrary{"osmesa", kFiles, "Debian package libosmesa6"};

constexpr int kFormat = 0x22, kDepthBits = 0x30, kStencilBits = 0x31, kProfile = 0x33, kCoreProfile = 0x34,
              kMajorVersion = 0x36, kMinorVersion = 0x37;
constexpr int kRgba = 0x1908;               // GL_RGBA
constexpr unsigned kUnsignedByte = 0x1401;  // GL_UNSIGNED_BYTE

/// The functions of the library, under its own names.
struct Functions {
  const GlLibrary& library;

  void* (*create_context)(const int* attributes, void* shared) = library.find("OSMesaCreateContextAttribs");
  unsigned char (*make_current)(void* context, void* buffer, unsigned type, int width,
                                int height) = library.find("OSMesaMakeCurrent");
  void (*destroy_context)(void* context) = library.find("OSMesaDestroyContext");
  GlContext::Function (*function)(const char* name) = library.find("OSMesaGetProcAddress");
};

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext() : library_(kLibrary), osmesa_{library_} {
    constexpr std::array<int, 13> kWanted{kFormat,  kRgba,        kDepthBits,    0, kStencilBits,  0,
                                          kProfile, kCoreProfile, kMajorVersion, 3, kMinorVersion, 3,
                                          0};
    context_ = osmesa_.create_context(kWanted.data(), nullptr);
    if (context_ == nullptr) library_.fail("makes no OpenGL 3.3 context");
    // The context's own buffer is never drawn into: everything goes to framebuffer objects.
    if (osmesa_.make_current(context_, buffer_.data(), kUnsignedByte, kSide, kSide) == 0) {
      osmesa_.destroy_context(context_);
      library_.fail("does not make its context current");
    }
  }

  ~OsMesaContext() override {
    osmesa_.make_current(nullptr, nullptr, 0, 0, 0);
    osmesa_.destroy_context(context_);
  }

  Function function(const char* name) const override { return osmesa_.function(name); }

 private:
  static constexpr int kSide = 8;
  GlLibrary library_;
  Functions osmesa_;
  void* context_ = nullptr;
  std::array<std::uint8_t, 4 * kSide * kSide> buffer_{};
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() {
  return std::make_unique<OsMesaContext>();
}

}  // namespace hallway::render
