// SPDX-License-Identifier: MIT
#include "host/machine/elf.hpp"

#include <fmt/format.h>
#include <hallway/entry.h>

#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "host/machine/elf_image.hpp"

namespace hallway::host {
namespace {

void check_kind(const ElfImage& image) {
  const Elf64_Ehdr& header = image.header();
  if (header.e_machine != our_machine()) {
    image.fail(fmt::format("is for another architecture: {}, this machine is {}",
                           machine_name(header.e_machine), machine_name(our_machine())));
  }
  if (header.e_type != ET_DYN) image.fail("is an ELF file, but not a shared object");
}

/// What the loader maps must be there: to touch a page beyond the end of the file ends the process.
void check_segments(const ElfImage& image) {
  for (const Elf64_Phdr& segment : image.segments()) {
    if (segment.p_type != PT_NULL) image.bytes(segment.p_offset, segment.p_filesz);
  }
}

std::optional<Elf64_Sym> find_symbol(const ElfImage& image, const Elf64_Shdr& table) {
  if (table.sh_link >= image.sections().size()) image.fail("is damaged: its symbol table has no names");
  const Elf64_Shdr& names_section = image.sections()[table.sh_link];
  const std::string_view names = image.bytes(names_section.sh_offset, names_section.sh_size);
  image.bytes(table.sh_offset, table.sh_size);
  for (std::uint64_t i = 0; i < table.sh_size / sizeof(Elf64_Sym); ++i) {
    const auto symbol = image.read<Elf64_Sym>(table.sh_offset, i);
    if (symbol.st_name >= names.size() || symbol.st_shndx == SHN_UNDEF) continue;
    if (ElfImage::text_at(names, symbol.st_name) == HW_ENTRY_SYMBOL) return symbol;
  }
  return std::nullopt;
}

hw_version_t read_abi(const ElfImage& image, const Elf64_Sym& symbol) {
  const auto offset = image.offset_of(symbol.st_value, sizeof(hw_version_t));
  if (!offset) image.fail("has an entry symbol that is no constant of the file");
  return image.read<hw_version_t>(*offset);
}

}  // namespace

std::optional<hw_version_t> find_entry(const ElfImage& image) {
  for (const Elf64_Shdr& section : image.sections()) {
    if (section.sh_type != SHT_DYNSYM) continue;
    if (const auto entry = find_symbol(image, section)) return read_abi(image, *entry);
  }
  return std::nullopt;
}

void check_library_file(const std::filesystem::path& file) {
  const std::string bytes = read_library(file);
  const ElfImage image(file, bytes);
  check_kind(image);
  check_segments(image);
  if (image.sections().empty()) return;
  const auto abi = find_entry(image);
  if (!abi) image.fail("has no entry symbol hw_entry: it is not a Hallway plugin");
  if (abi->abi_major != HW_ABI_MAJOR) {
    image.fail(fmt::format("was built for version {}.{} of the plugin ABI, this program speaks version {}.x",
                           abi->abi_major, abi->abi_minor, HW_ABI_MAJOR));
  }
}

}  // namespace hallway::host
