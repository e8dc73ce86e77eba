// SPDX-License-Identifier: MIT
#include "render/gl_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/text.hpp"
#include "render/renderer.hpp"

namespace hallway::render {
namespace {

/// The loader's words where a file is there and cannot be used, such as one that needs another; that it is not there is said otherwise.
std::string other_problem(const char* file) {
  const char* words = ::dlerror();
  const std::string text = words != nullptr ? words : "";
  const bool not_there = text.starts_with(file) &&
                         text.find("cannot open shared object file: No such file") != std::string::npos;
  return not_there || text.empty() ? "" : "; " + printable(text, 4096);
}

}  // namespace

GlLibrary::GlLibrary(const GlLibraryNames& names) : names_(names) {
  std::string problems;
  for (const char* file : names_.files) {
    handle_ = ::dlopen(file, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      file_ = file;
      return;
    }
    problems += other_problem(file);
  }
  throw NoRenderer(fmt::format("{} is not available: tried {} ({}){}", names_.renderer,
                               fmt::join(names_.files, ", "), names_.packages, problems));
}

void GlLibrary::fail(const std::string& cause) const {
  throw NoRenderer(fmt::format("{}: {} {} ({})", names_.renderer, file_, cause, names_.packages));
}

EntryPoint GlLibrary::find(const char* name) const {
  void* address = ::dlsym(handle_, name);
  if (address == nullptr) fail(std::string("has no ") + name);
  return {address};
}

}  // namespace hallway::render
