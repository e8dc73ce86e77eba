// SPDX-License-Identifier: MIT
#include "host/isolate/process_use.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <string>
#include <string_view>

#include "base/text.hpp"

namespace hallway::host {

std::optional<ProcessUse> read_process_use(pid_t pid) {
  const std::string path = "/proc/" + std::to_string(pid) + "/stat";
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  std::array<char, 2048> buffer{};
  const ssize_t got = ::read(fd, buffer.data(), buffer.size());
  ::close(fd);
  std::string_view text(buffer.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  // The second field is the program's name in brackets, which may hold anything.
  const std::size_t bracket = text.rfind(')');
  if (bracket == std::string_view::npos) return std::nullopt;
  text.remove_prefix(bracket + 2);
  const auto fields = split(text, ' ');  // from the third: man proc(5)
  if (fields.size() < 22) return std::nullopt;
  const auto threads = parse_uint(fields[17]);
  const auto pages = parse_uint(fields[21]);
  if (!threads || !pages) return std::nullopt;
  return ProcessUse{*pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)), *threads};
}

}  // namespace hallway::host
