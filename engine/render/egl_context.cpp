// SPDX-License-Identifier: MIT
//
// EGL without a window system, in software on every machine: pictures shall not depend on the graphics card.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

#include "base/text.hpp"
#include "render/gl_context.hpp"
#include "render/gl_library.hpp"

namespace hallway::render {
namespace {

constexpr std::array<const char*, 1> kFiles{"libEGL.so.1"};
constexpr GlLibraryNames kLibrary{"egl", kFiles, "Debian packages libegl1, libegl-mesa0 and libgl1-mesa-dri"};

/// The functions of the library, under its own names.
struct Functions {
  const GlLibrary& library;

  decltype(&eglQueryString) query_string = library.find("eglQueryString");
  decltype(&eglGetProcAddress) function = library.find("eglGetProcAddress");
  decltype(&eglInitialize) initialize = library.find("eglInitialize");
  decltype(&eglBindAPI) bind_api = library.find("eglBindAPI");
  decltype(&eglChooseConfig) choose_config = library.find("eglChooseConfig");
  decltype(&eglCreateContext) create_context = library.find("eglCreateContext");
  decltype(&eglDestroyContext) destroy_context = library.find("eglDestroyContext");
  decltype(&eglCreatePbufferSurface) create_surface = library.find("eglCreatePbufferSurface");
  decltype(&eglDestroySurface) destroy_surface = library.find("eglDestroySurface");
  decltype(&eglMakeCurrent) make_current = library.find("eglMakeCurrent");
  decltype(&eglReleaseThread) release_thread = library.find("eglReleaseThread");

  /// A function of an extension; null where there is none.
  template <class T>
  T extension(const char* name) const {
    return reinterpret_cast<T>(function(name));
  }

  /// Whether a list of extensions has one. @param list  of eglQueryString(); may be null
  static bool has(const char* list, std::string_view extension) {
    if (list == nullptr) return false;
    for (const std::string_view word : split(list, ' ')) {
      if (word == extension) return true;
    }
    return false;
  }
};

/// Mesa's software device; EGL_NO_DISPLAY where there is none.
EGLDisplay software_device(const Functions& egl) {
  const char* extensions = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!egl.has(extensions, "EGL_EXT_platform_device")) return EGL_NO_DISPLAY;
  const auto query_devices = egl.extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string = egl.extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  const auto display_of = egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (query_devices == nullptr || query_string == nullptr || display_of == nullptr) return EGL_NO_DISPLAY;
  std::array<EGLDeviceEXT, 64> devices{};
  EGLint count = 0;
  if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE)
    return EGL_NO_DISPLAY;
  for (EGLint i = 0; i < count; ++i) {
    const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    if (egl.has(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software"))
      return display_of(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  }
  return EGL_NO_DISPLAY;
}

/// Mesa's platform without windows, which takes a graphics card where it finds one.
EGLDisplay surfaceless_platform(const Functions& egl) {
  if (!egl.has(egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
    return EGL_NO_DISPLAY;
  const auto display_of = egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  return display_of == nullptr ? EGL_NO_DISPLAY
                               : display_of(EGL_PLATFORM_SURFACELESS_MESA,
                                            reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
}

class EglContext final : public GlContext {
 public:
  EglContext() : library_(kLibrary), egl_{library_} {
    try {
      open_display();
      make_context();
      make_current();
      demand_software();
    } catch (...) {
      close();
      throw;
    }
  }

  ~EglContext() override { close(); }

  Function function(const char* name) const override { return egl_.function(name); }

 private:
  /// A display is one for the whole program and stays open: another thread may draw on it.
  void open_display() {
    for (const auto find : {software_device, surfaceless_platform}) {
      display_ = find(egl_);
      if (display_ != EGL_NO_DISPLAY && egl_.initialize(display_, nullptr, nullptr) == EGL_TRUE) return;
    }
    display_ = EGL_NO_DISPLAY;
    library_.fail("offers no software renderer");
  }

  void make_context() {
    constexpr std::array<EGLint, 5> kConfig{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                            EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array<EGLint, 7> kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
    EGLint count = 0;
    if (egl_.bind_api(EGL_OPENGL_API) == EGL_FALSE ||
        egl_.choose_config(display_, kConfig.data(), &config_, 1, &count) == EGL_FALSE || count == 0)
      library_.fail("offers no OpenGL");
    context_ = egl_.create_context(display_, config_, EGL_NO_CONTEXT, kVersion.data());
    if (context_ == EGL_NO_CONTEXT) library_.fail("makes no OpenGL 3.3 context");
  }

  void make_current() {
    if (!Functions::has(egl_.query_string(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
      constexpr std::array<EGLint, 5> kSize{EGL_WIDTH, 8, EGL_HEIGHT, 8, EGL_NONE};
      surface_ = egl_.create_surface(display_, config_, kSize.data());
    }
    if (egl_.make_current(display_, surface_, surface_, context_) == EGL_FALSE)
      library_.fail("does not make its context current");
  }

  void demand_software() {
    using GetString = const unsigned char* (*)(unsigned);
    constexpr unsigned kRenderer = 0x1F01;  // GL_RENDERER
    const auto get = egl_.extension<GetString>("glGetString");
    const auto* text = get != nullptr ? reinterpret_cast<const char*>(get(kRenderer)) : nullptr;
    const std::string_view name = text != nullptr ? text : "";
    for (const char* software : {"llvmpipe", "softpipe"}) {
      if (name.starts_with(software)) return;
    }
    library_.fail(fmt::format("renders with \"{}\" and offers no software renderer", printable(name)));
  }

  void close() {
    if (display_ == EGL_NO_DISPLAY) return;
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) egl_.destroy_context(display_, context_);
    if (surface_ != EGL_NO_SURFACE) egl_.destroy_surface(display_, surface_);
    egl_.release_thread();
  }

  GlLibrary library_;
  Functions egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLConfig config_ = nullptr;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_context() {
  return std::make_unique<EglContext>();
}

}  // namespace hallway::render
