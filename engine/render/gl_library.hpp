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

/// The address of a function, which becomes a pointer to the function that it is said to be.
struct EntryPoint {
  void* address = nullptr;

  template <class Function>
  operator Function*() const {
    return reinterpret_cast<Function*>(address);
  }
};

/// A shared library that renders, opened at run time. It stays loaded to the end of the program: Mesa and LLVM leave functions behind that
/// are called at the end of threads and of the program.
class GlLibrary {
 public:
  /// Throws NoRenderer if none of the files can be opened.
  explicit GlLibrary(const GlLibraryNames& names);

  /// Throws NoRenderer if the library has no such function.
  EntryPoint find(const char* name) const;

  /// Throws NoRenderer: the library is there, and `cause` is why it does not draw.
  [[noreturn]] void fail(const std::string& cause) const;

 private:
  GlLibraryNames names_;
  const char* file_ = nullptr;  ///< that was opened
  void* handle_ = nullptr;
};

}  // namespace hallway::render
