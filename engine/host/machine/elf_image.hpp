// SPDX-License-Identifier: MIT
#pragma once

#include <elf.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"

namespace hallway::host {

/// "x86-64", "AArch64", "ELF machine 99".
std::string machine_name(Elf64_Half machine);

/// The machine that this program was compiled for.
Elf64_Half our_machine();

/// The bytes of a 64-bit little-endian ELF file. Every read is checked against their end; what the headers announce and the file does
/// not hold is Error{kPluginLoad}, as is anything else that is not as the format says.
class ElfImage {
 public:
  /// Reads the header. Keeps `bytes`, not a copy.
  ElfImage(const std::filesystem::path& file, std::string_view bytes);

  [[noreturn]] void fail(const std::string& message) const;

  const Elf64_Ehdr& header() const { return header_; }
  const std::vector<Elf64_Phdr>& segments() const { return segments_; }
  /// Empty where the file has none: they are not needed to load it.
  const std::vector<Elf64_Shdr>& sections() const { return sections_; }

  std::string_view bytes(std::uint64_t offset, std::uint64_t size) const;
  template <typename T>
  T read(std::uint64_t offset) const {
    return load<T>(bytes(offset, sizeof(T)).data());
  }
  /// Entry `index` of a table that begins at `offset`.
  template <typename T>
  T read(std::uint64_t offset, std::uint64_t index) const {
    if (offset > bytes_.size() || index > bytes_.size())
      fail("is cut off: it ends before what its headers announce");
    return read<T>(offset + index * sizeof(T));
  }
  /// Where in the file stands what is loaded to an address; none for what is not from the file.
  std::optional<std::uint64_t> offset_of(std::uint64_t address, std::uint64_t size) const;
  /// The text at `offset` of a table of texts, to its end or that of the table.
  static std::string_view text_at(std::string_view table, std::uint64_t offset);

 private:
  std::filesystem::path file_;
  std::string_view bytes_;
  Elf64_Ehdr header_{};
  std::vector<Elf64_Phdr> segments_;
  std::vector<Elf64_Shdr> sections_;
};

/// A library's whole content. Throws Error{kPluginLoad}: it does not exist, is no regular file, or cannot be read.
std::string read_library(const std::filesystem::path& file);

}  // namespace hallway::host
