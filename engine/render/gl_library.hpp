// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

namespace hallway::render {

/// Where a renderer's library is found.
struct GlLibraryNames {
  const char* renderer;                ///< as in kRendererNames
  std::span<const char* const> files;  ///< sonames, the first that there is counts
  const char* packages;                ///< Debian packages that have it
};

/// A shared library that renders, opened at run time. It stays loaded to the end of the program: Mesa and LLVM leave functions behind that
/// are called at the end of threads and of the program.
class GlLibrary {
 public:
  /// Throws NoRenderer if none of the files can be opened.
  explicit GlLibrary(const GlLibraryNames& names);

  /// Puts the entry point of a function into a pointer to such a function. Throws NoRenderer if the library has none.
  template <class T>
  void find(const char* name, T& function) const {
    function = reinterpret_cast<T>(symbol(name));
  }

  /// Throws NoRenderer: the library is there, and `cause` is why it does not draw.
  [[noreturn]] void fail(const std::string& cause) const;

 private:
  void* symbol(const char* name) const;

  GlLibraryNames names_;
  const char* file_ = nullptr;  ///< that was opened
  void* handle_ = nullptr;
};

}  // namespace hallway::render
