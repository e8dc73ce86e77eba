// SPDX-License-Identifier: MIT
#include "host/machine/library_facts.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/machine/elf.hpp"
#include "host/machine/elf_image.hpp"

namespace hallway::host {
namespace {

/// More entries than any library has: a table that is longer is damaged.
constexpr std::size_t kMostEntries = 100'000;

/// The dynamic section: what the loader reads.
class DynamicSection {
 public:
  explicit DynamicSection(const ElfImage& image) : image_(image) {
    for (const Elf64_Phdr& segment : image.segments()) {
      if (segment.p_type != PT_DYNAMIC) continue;
      image.bytes(segment.p_offset, segment.p_filesz);
      const std::uint64_t count = std::min<std::uint64_t>(segment.p_filesz / sizeof(Elf64_Dyn), kMostEntries);
      for (std::uint64_t i = 0; i < count; ++i) {
        const auto entry = image.read<Elf64_Dyn>(segment.p_offset, i);
        if (entry.d_tag == DT_NULL) break;
        entries_.push_back(entry);
      }
    }
    const auto texts = value(DT_STRTAB), size = value(DT_STRSZ);
    if (!texts || !size) return;
    const auto offset = image.offset_of(*texts, *size);
    if (!offset) image.fail("is damaged: its dynamic section's texts are not in the file");
    texts_ = image.bytes(*offset, *size);
  }

  std::optional<std::uint64_t> value(Elf64_Sxword tag) const {
    for (const Elf64_Dyn& entry : entries_) {
      if (entry.d_tag == tag) return entry.d_un.d_val;
    }
    return std::nullopt;
  }

  /// The texts of all entries with a tag, in their order.
  std::vector<std::string> texts(Elf64_Sxword tag) const {
    std::vector<std::string> all;
    for (const Elf64_Dyn& entry : entries_) {
      if (entry.d_tag == tag) all.emplace_back(text(entry.d_un.d_val));
    }
    return all;
  }

  std::string_view text(std::uint64_t offset) const { return ElfImage::text_at(texts_, offset); }

  /// Where in the file the table stands whose address a tag has; none without the tag.
  std::optional<std::uint64_t> table(Elf64_Sxword tag, std::uint64_t entry_size) const {
    const auto address = value(tag);
    if (!address) return std::nullopt;
    const auto offset = image_.offset_of(*address, entry_size);
    if (!offset) image_.fail("is damaged: a table of its dynamic section is not in the file");
    return offset;
  }

 private:
  const ElfImage& image_;
  std::vector<Elf64_Dyn> entries_;
  std::string_view texts_;
};

std::vector<NeededVersion> needed_versions(const ElfImage& image, const DynamicSection& dynamic) {
  std::vector<NeededVersion> versions;
  auto at = dynamic.table(DT_VERNEED, sizeof(Elf64_Verneed));
  for (std::size_t library = 0; at && library < kMostEntries; ++library) {
    const auto need = image.read<Elf64_Verneed>(*at);
    std::uint64_t version_at = *at + need.vn_aux;
    for (unsigned i = 0; i < need.vn_cnt; ++i) {
      const auto version = image.read<Elf64_Vernaux>(version_at);
      versions.push_back(
          {std::string(dynamic.text(need.vn_file)), std::string(dynamic.text(version.vna_name))});
      if (version.vna_next == 0 || versions.size() > kMostEntries) break;
      version_at += version.vna_next;
    }
    if (need.vn_next == 0) break;
    *at += need.vn_next;
  }
  return versions;
}

std::vector<std::string> defined_versions(const ElfImage& image, const DynamicSection& dynamic) {
  std::vector<std::string> versions;
  auto at = dynamic.table(DT_VERDEF, sizeof(Elf64_Verdef));
  for (std::size_t i = 0; at && i < kMostEntries; ++i) {
    const auto definition = image.read<Elf64_Verdef>(*at);
    const auto name = image.read<Elf64_Verdaux>(*at + definition.vd_aux);
    versions.emplace_back(dynamic.text(name.vda_name));
    if (definition.vd_next == 0) break;
    *at += definition.vd_next;
  }
  return versions;
}

void add_exports(LibraryFacts& facts, const ElfImage& image) {
  for (const Elf64_Shdr& section : image.sections()) {
    if (section.sh_type != SHT_DYNSYM || section.sh_link >= image.sections().size()) continue;
    facts.symbols_known = true;
    const Elf64_Shdr& names_section = image.sections()[section.sh_link];
    const std::string_view names = image.bytes(names_section.sh_offset, names_section.sh_size);
    image.bytes(section.sh_offset, section.sh_size);
    for (std::uint64_t i = 0; i < section.sh_size / sizeof(Elf64_Sym); ++i) {
      const auto symbol = image.read<Elf64_Sym>(section.sh_offset, i);
      const unsigned binding = ELF64_ST_BIND(symbol.st_info), type = ELF64_ST_TYPE(symbol.st_info);
      const bool global = binding == STB_GLOBAL || binding == STB_WEAK || binding == STB_GNU_UNIQUE;
      const bool named = type == STT_FUNC || type == STT_OBJECT || type == STT_NOTYPE || type == STT_TLS;
      if (symbol.st_shndx == SHN_UNDEF || symbol.st_shndx == SHN_ABS || !global || !named) continue;
      facts.exports.emplace_back(ElfImage::text_at(names, symbol.st_name));
    }
  }
  std::ranges::sort(facts.exports);
}

std::vector<std::string> folders_of(const DynamicSection& dynamic) {
  auto lists = dynamic.texts(DT_RUNPATH);
  if (lists.empty())
    lists = dynamic.texts(DT_RPATH);  // which the loader takes only where there is no RUNPATH
  std::vector<std::string> folders;
  for (const std::string& list : lists) {
    for (const std::string_view folder : split(list, ':')) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  return folders;
}

void read_whole(LibraryFacts& facts, std::string_view bytes) {
  const ElfImage image(facts.file, bytes);
  facts.machine = machine_name(image.header().e_machine);
  facts.shared_object = image.header().e_type == ET_DYN;
  for (const Elf64_Phdr& segment : image.segments()) {
    if (segment.p_type != PT_NULL) image.bytes(segment.p_offset, segment.p_filesz);
  }
  const DynamicSection dynamic(image);
  facts.needed = dynamic.texts(DT_NEEDED);
  facts.search_folders = folders_of(dynamic);
  facts.needed_versions = needed_versions(image, dynamic);
  facts.defined_versions = defined_versions(image, dynamic);
  add_exports(facts, image);
  facts.abi = find_entry(image);
  facts.whole = true;
}

/// The machine of a file that this program cannot load, whatever its word size and byte order.
std::string foreign_machine(std::string_view bytes) {
  constexpr std::size_t kMachineAt = 18;
  if (bytes.size() < kMachineAt + 2 || bytes.substr(0, SELFMAG) != std::string_view(ELFMAG, SELFMAG))
    return {};
  const auto byte = [&](std::size_t at) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[at]));
  };
  const bool big = bytes[EI_DATA] == ELFDATA2MSB;
  const unsigned machine =
      big ? byte(kMachineAt) << 8 | byte(kMachineAt + 1) : byte(kMachineAt + 1) << 8 | byte(kMachineAt);
  std::string name = machine_name(static_cast<Elf64_Half>(machine));
  if (big) name += ", big-endian";
  if (bytes[EI_CLASS] == ELFCLASS32 && name.find("32-bit") == std::string::npos) name += ", 32-bit";
  return name;
}

}  // namespace

LibraryFacts read_library_facts(const std::filesystem::path& file) {
  const std::string bytes = read_library(file);
  LibraryFacts facts;
  facts.file = file;
  facts.machine = foreign_machine(bytes);
  try {
    read_whole(facts, bytes);
  } catch (const Error& error) {
    facts.problem = error.message();
  }
  return facts;
}

}  // namespace hallway::host
