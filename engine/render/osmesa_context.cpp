// SPDX-License-Identifier: MIT
#include <GL/osmesa.h>

#include <array>
#include <cstdint>

#include "base/error.hpp"
#include "render/gl_context.hpp"

namespace hallway::render {
namespace {

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext() {
    constexpr std::array<int, 13> kWanted{OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          0,
                                          OSMESA_STENCIL_BITS,
                                          0,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          3,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          3,
                                          0};
    context_ = OSMesaCreateContextAttribs(kWanted.data(), nullptr);
    if (context_ == nullptr) fail("OSMesa makes no OpenGL 3.3 context");
    // The context's own buffer is never drawn into: everything goes to framebuffer objects.
    if (OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE) {
      OSMesaDestroyContext(context_);
      fail("the OSMesa context cannot be made current");
    }
  }

  ~OsMesaContext() override {
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context_);
  }

  Function function(const char* name) const override { return OSMesaGetProcAddress(name); }

 private:
  [[noreturn]] static void fail(const char* cause) {
    throw Error(ErrorCode::kIo, std::string("no picture can be drawn: ") + cause);
  }

  static constexpr int kSide = 8;
  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, 4 * kSide * kSide> buffer_{};
};

}  // namespace

std::unique_ptr<GlContext> make_offscreen_context() {
  return std::make_unique<OsMesaContext>();
}

}  // namespace hallway::render
