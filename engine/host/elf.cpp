// SPDX-License-Identifier: MIT
#include "host/elf.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <hallway/entry.h>

#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/file.hpp"

namespace hallway::host {
namespace {

constexpr std::uint64_t kMaxLibraryBytes = 1ull << 30;

#if defined(__x86_64__)
constexpr Elf64_Half kOurMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half kOurMachine = EM_AARCH64;
#else
#error "which ELF machine is this?"
#endif

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

/// The file's bytes; every read is checked against their end.
class Image {
 public:
  Image(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::kPluginLoad, message, {file_.string()});
  }

  bool holds(std::uint64_t offset, std::uint64_t size) const {
    return offset <= bytes_.size() && size <= bytes_.size() - offset;
  }

  std::string_view bytes(std::uint64_t offset, std::uint64_t size) const {
    if (!holds(offset, size)) fail("is cut off: it ends before what its headers announce");
    return bytes_.substr(offset, size);
  }

  template <typename T>
  T read(std::uint64_t offset) const {
    T value;
    std::memcpy(&value, bytes(offset, sizeof value).data(), sizeof value);
    return value;
  }

  /// Entry `index` of a table that begins at `offset`.
  template <typename T>
  T read(std::uint64_t offset, std::uint64_t index) const {
    if (offset > bytes_.size()) fail("is cut off: it ends before what its headers announce");
    return read<T>(offset + index * sizeof(T));
  }

 private:
  const std::filesystem::path& file_;
  std::string_view bytes_;
};

Elf64_Ehdr check_header(const Image& image) {
  if (!image.holds(0, SELFMAG) || image.bytes(0, SELFMAG) != std::string_view(ELFMAG, SELFMAG)) {
    image.fail("is not an ELF file");
  }
  const std::string_view identity = image.bytes(0, EI_NIDENT);
  if (identity[EI_CLASS] != ELFCLASS64 || identity[EI_DATA] != ELFDATA2LSB) {
    image.fail("is for another architecture: it is not a 64-bit little-endian file");
  }
  const auto header = image.read<Elf64_Ehdr>(0);
  if (header.e_machine != kOurMachine) {
    image.fail(fmt::format("is for another architecture: {}, this machine is {}",
                           machine_name(header.e_machine), machine_name(kOurMachine)));
  }
  if (header.e_type != ET_DYN) image.fail("is an ELF file, but not a shared object");
  if (header.e_phentsize != sizeof(Elf64_Phdr)) {
    image.fail("is damaged: its program headers have a wrong size");
  }
  return header;
}

/// What the loader maps must be there: to touch a page beyond the end of the file ends the process.
void check_segments(const Image& image, const Elf64_Ehdr& header) {
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    const auto segment = image.read<Elf64_Phdr>(header.e_phoff, i);
    if (segment.p_type != PT_NULL) image.bytes(segment.p_offset, segment.p_filesz);
  }
}

std::optional<Elf64_Sym> find_symbol(const Image& image, const Elf64_Ehdr& header, const Elf64_Shdr& table) {
  if (table.sh_link >= header.e_shnum) image.fail("is damaged: its symbol table has no names");
  const auto names_section = image.read<Elf64_Shdr>(header.e_shoff, table.sh_link);
  const std::string_view names = image.bytes(names_section.sh_offset, names_section.sh_size);
  image.bytes(table.sh_offset, table.sh_size);
  for (std::uint64_t i = 0; i < table.sh_size / sizeof(Elf64_Sym); ++i) {
    const auto symbol = image.read<Elf64_Sym>(table.sh_offset, i);
    if (symbol.st_name >= names.size() || symbol.st_shndx == SHN_UNDEF) continue;
    const std::string_view rest = names.substr(symbol.st_name);
    if (rest.substr(0, rest.find('\0')) == HW_ENTRY_SYMBOL) return symbol;
  }
  return std::nullopt;
}

hw_version_t read_abi(const Image& image, const Elf64_Ehdr& header, const Elf64_Sym& symbol) {
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    const auto segment = image.read<Elf64_Phdr>(header.e_phoff, i);
    if (segment.p_type != PT_LOAD || symbol.st_value < segment.p_vaddr) continue;
    const std::uint64_t offset = symbol.st_value - segment.p_vaddr;
    if (offset > segment.p_filesz || segment.p_filesz - offset < sizeof(hw_version_t)) continue;
    return image.read<hw_version_t>(segment.p_offset + offset);
  }
  image.fail("has an entry symbol that is no constant of the file");
}

void check_entry(const Image& image, const Elf64_Ehdr& header) {
  if (header.e_shoff == 0 || header.e_shnum == 0) return;
  if (header.e_shentsize != sizeof(Elf64_Shdr)) {
    image.fail("is damaged: its section headers have a wrong size");
  }
  image.bytes(header.e_shoff, header.e_shnum * sizeof(Elf64_Shdr));
  std::optional<Elf64_Sym> entry;
  for (unsigned i = 0; i < header.e_shnum && !entry; ++i) {
    const auto section = image.read<Elf64_Shdr>(header.e_shoff, i);
    if (section.sh_type == SHT_DYNSYM) entry = find_symbol(image, header, section);
  }
  if (!entry) image.fail("has no entry symbol hw_entry: it is not a Hallway plugin");
  const hw_version_t abi = read_abi(image, header, *entry);
  if (abi.abi_major != HW_ABI_MAJOR) {
    image.fail(fmt::format("was built for version {}.{} of the plugin ABI, this program speaks version {}.x",
                           abi.abi_major, abi.abi_minor, HW_ABI_MAJOR));
  }
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

}  // namespace

void check_library_file(const std::filesystem::path& file) {
  const std::string bytes = read_library(file);
  const Image image(file, bytes);
  const Elf64_Ehdr header = check_header(image);
  check_segments(image, header);
  check_entry(image, header);
}

}  // namespace hallway::host
