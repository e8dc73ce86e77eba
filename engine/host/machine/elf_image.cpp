// SPDX-License-Identifier: MIT
#include "host/machine/elf_image.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"

namespace hallway::host {
namespace {

constexpr std::uint64_t kMaxLibraryBytes = 1ull << 30;

}  // namespace

std::string machine_name(Elf64_Half machine) {
  switch (machine) {
    case EM_X86_64:
      return "x86-64";
    case EM_AARCH64:
      return "AArch64";
    case EM_386:
      return "i386";
    case EM_ARM:
      return "32-bit ARM";
    case EM_RISCV:
      return "RISC-V";
    default:
      return fmt::format("ELF machine {}", machine);
  }
}

Elf64_Half our_machine() {
#if defined(__x86_64__)
  return EM_X86_64;
#elif defined(__aarch64__)
  return EM_AARCH64;
#else
#error "which ELF machine is this?"
#endif
}

ElfImage::ElfImage(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {
  if (bytes_.size() < SELFMAG || bytes_.substr(0, SELFMAG) != std::string_view(ELFMAG, SELFMAG)) {
    fail("is not an ELF file");
  }
  const std::string_view identity = this->bytes(0, EI_NIDENT);
  if (identity[EI_CLASS] != ELFCLASS64 || identity[EI_DATA] != ELFDATA2LSB) {
    fail("is for another architecture: it is not a 64-bit little-endian file");
  }
  header_ = read<Elf64_Ehdr>(0);
  if (header_.e_phnum != 0 && header_.e_phentsize != sizeof(Elf64_Phdr)) {
    fail("is damaged: its program headers have a wrong size");
  }
  for (unsigned i = 0; i < header_.e_phnum; ++i) segments_.push_back(read<Elf64_Phdr>(header_.e_phoff, i));
  if (header_.e_shoff == 0 || header_.e_shnum == 0) return;
  if (header_.e_shentsize != sizeof(Elf64_Shdr)) fail("is damaged: its section headers have a wrong size");
  for (unsigned i = 0; i < header_.e_shnum; ++i) sections_.push_back(read<Elf64_Shdr>(header_.e_shoff, i));
}

void ElfImage::fail(const std::string& message) const {
  throw Error(ErrorCode::kPluginLoad, message, {file_.string()});
}

std::string_view ElfImage::bytes(std::uint64_t offset, std::uint64_t size) const {
  if (!lies_within(offset, size, bytes_.size())) fail("is cut off: it ends before what its headers announce");
  return bytes_.substr(offset, size);
}

std::optional<std::uint64_t> ElfImage::offset_of(std::uint64_t address, std::uint64_t size) const {
  for (const Elf64_Phdr& segment : segments_) {
    if (segment.p_type != PT_LOAD || address < segment.p_vaddr) continue;
    const std::uint64_t within = address - segment.p_vaddr;
    if (within > segment.p_filesz || segment.p_filesz - within < size) continue;
    if (segment.p_offset > bytes_.size()) continue;
    return segment.p_offset + within;
  }
  return std::nullopt;
}

std::string_view ElfImage::text_at(std::string_view table, std::uint64_t offset) {
  if (offset >= table.size()) return {};
  const std::string_view rest = table.substr(offset);
  return rest.substr(0, rest.find('\0'));
}

std::string read_library(const std::filesystem::path& file) {
  std::error_code problem;
  const auto status = std::filesystem::status(file, problem);
  if (!std::filesystem::exists(status)) {
    throw Error(ErrorCode::kPluginLoad, "does not exist", {file.string()});
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw Error(ErrorCode::kPluginLoad, "is not a regular file", {file.string()});
  }
  try {
    return read_file(file, kMaxLibraryBytes);
  } catch (const Error& error) {
    throw Error(ErrorCode::kPluginLoad, error.message(), {file.string()});
  }
}

}  // namespace hallway::host
