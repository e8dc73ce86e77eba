// SPDX-License-Identifier: MIT
#include "base/sandbox.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <system_error>

#include "base/helper.hpp"

// Of later kernels than the headers may be of.
#ifndef LANDLOCK_ACCESS_FS_REFER
#define LANDLOCK_ACCESS_FS_REFER (1ULL << 13)
#endif
#ifndef LANDLOCK_ACCESS_FS_TRUNCATE
#define LANDLOCK_ACCESS_FS_TRUNCATE (1ULL << 14)
#endif

namespace hallway {
namespace {

bool limit(int resource, std::uint64_t value) {
  const rlimit wanted{value, value};
  return ::setrlimit(static_cast<__rlimit_resource_t>(resource), &wanted) == 0;
}

void set_limits(const Confinement& confinement, std::vector<std::string>& missing) {
  bool good = limit(RLIMIT_CORE, 0) && limit(RLIMIT_FSIZE, confinement.file_bytes) &&
              limit(RLIMIT_NOFILE, confinement.open_files);
  // Not the address space: what a program reserves says little of what it uses. Not RLIMIT_NPROC: it counts all processes of the user.
  if (!reserves_addresses()) good = good && limit(RLIMIT_DATA, confinement.data_bytes);
  if (!good) missing.emplace_back("not all limits could be set");
}

/// Keeps of root's powers the one to read files.
bool drop_powers() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[_LINUX_CAPABILITY_U32S_3]{};
  if (::syscall(SYS_capget, &header, data) != 0) return false;
  const std::uint32_t kept = data[0].permitted & (1u << CAP_DAC_READ_SEARCH);
  data[0] = {kept, kept, 0};
  data[1] = {};
  return ::syscall(SYS_capset, &header, data) == 0;
}

/// Rights that change files, of those that this version of Landlock knows.
std::uint64_t changing_rights(long version) {
  std::uint64_t rights = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                         LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                         LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                         LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                         LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  if (version >= 2) rights |= LANDLOCK_ACCESS_FS_REFER;
  if (version >= 3) rights |= LANDLOCK_ACCESS_FS_TRUNCATE;
  return rights;
}

bool allow_beneath(int ruleset, const std::filesystem::path& path, std::uint64_t rights) {
  const int fd = ::open(path.c_str(), O_PATH | O_CLOEXEC);
  if (fd < 0) return false;
  const landlock_path_beneath_attr rule{rights, fd};
  const long added = ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  ::close(fd);
  return added == 0;
}

/// Lets a file be written, or all beneath a folder.
bool allow_writes(int ruleset, const std::filesystem::path& path, std::uint64_t rights) {
  std::error_code problem;
  const bool is_folder = std::filesystem::is_directory(path, problem);
  const std::uint64_t of_files = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_TRUNCATE;
  return allow_beneath(ruleset, path, is_folder ? rights : rights & of_files);
}

/// No file is changed but those that `confinement` names. @return false if the kernel cannot see to that
bool restrain_writes(const Confinement& confinement) {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, std::size_t{0}, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  const std::uint64_t rights = changing_rights(version);
  const std::uint64_t attributes = rights;  // struct landlock_ruleset_attr of the first version
  const auto ruleset =
      static_cast<int>(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  if (ruleset < 0) return false;
  allow_beneath(ruleset, "/dev/null", LANDLOCK_ACCESS_FS_WRITE_FILE);
  bool good = confinement.scratch.empty() || allow_beneath(ruleset, confinement.scratch, rights);
  for (const std::filesystem::path& path : confinement.writable)
    good = allow_writes(ruleset, path, rights) && good;
  good = ::syscall(SYS_landlock_restrict_self, ruleset, 0) == 0 && good;
  ::close(ruleset);
  return good;
}

}  // namespace

std::vector<std::string> confine(const Confinement& confinement) {
  std::vector<std::string> missing;
  set_limits(confinement, missing);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) missing.emplace_back("no_new_privs is not known here");
  const bool restrained = restrain_writes(confinement);
  if (!drop_powers()) missing.emplace_back("the powers of root could not be given up");
  const bool filtered = filter_system_calls(restrained ? FileWrites::kAllowed : FileWrites::kNone);
  if (!filtered) {
    missing.emplace_back("system calls are not filtered (no seccomp): sockets and processes are open to it");
  }
  if (!restrained) {
    missing.emplace_back(
        filtered ? "the kernel has no Landlock: it can write no file at all, not even a scratch one"
                 : "the kernel has no Landlock: it can write files");
  }
  return missing;
}

}  // namespace hallway
