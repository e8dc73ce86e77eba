// SPDX-License-Identifier: MIT
#include "base/sandbox.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hallway {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
constexpr std::uint32_t kFirstForeignCall = 0x40000000;  // those of the x32 ABI
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
constexpr std::uint32_t kFirstForeignCall = 0xffffffff;
#else
constexpr std::uint32_t kArchitecture = 0;  // no filter: the numbers of its calls are not known here
constexpr std::uint32_t kFirstForeignCall = 0;
#endif

/// Refused whatever the arguments.
constexpr std::uint32_t kRefused[] = {
    // Other machines and programs.
    SYS_socket, SYS_execve, SYS_execveat, SYS_io_uring_setup,
#ifdef SYS_fork
    SYS_fork, SYS_vfork,
#endif
    // Other processes.
    SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_tkill, SYS_pidfd_open, SYS_pidfd_send_signal,
    SYS_setrlimit, SYS_setpriority, SYS_setpgid, SYS_setsid,
    // What Landlock leaves open of files: rights, owners, times, attributes, length.
    SYS_fchmod, SYS_fchmodat, SYS_fchown, SYS_fchownat, SYS_utimensat, SYS_setxattr, SYS_lsetxattr,
    SYS_fsetxattr, SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr,
#ifdef SYS_chmod
    SYS_chmod, SYS_chown, SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat,
#endif
    // The machine.
    SYS_unshare, SYS_setns, SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_bpf, SYS_perf_event_open,
    SYS_add_key, SYS_request_key, SYS_keyctl, SYS_userfaultfd};

/// Refused too where nothing else restrains writing.
constexpr std::uint32_t kFileChanges[] = {
    SYS_openat2,  SYS_unlinkat,  SYS_renameat2, SYS_mkdirat, SYS_mknodat,
    SYS_linkat,   SYS_symlinkat, SYS_truncate,
#ifdef SYS_renameat
    SYS_renameat,
#endif
#ifdef SYS_unlink
    SYS_creat,    SYS_unlink,    SYS_rename,    SYS_mkdir,   SYS_rmdir,
    SYS_mknod,    SYS_link,      SYS_symlink
#endif
};

/// A program of the kernel's packet filter over seccomp_data, put together from rules: each looks at one call and ends the program if it is that
/// one.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    jump(BPF_JEQ, kArchitecture, 1, 0);
    refuse(ENOSYS);
    load_call();
    jump(BPF_JGE, kFirstForeignCall, 0, 1);
    refuse(ENOSYS);
  }

  void refuse_call(std::uint32_t call, int reason = EPERM) {
    jump(BPF_JEQ, call, 0, 1);
    refuse(reason);
  }

  /// Refuses the call if (argument & mask) has any bit.
  void refuse_bits(std::uint32_t call, int argument, std::uint32_t mask) {
    judge(call, argument, BPF_JSET, mask, 0, 1);
  }
  /// Refuses the call unless (argument & mask) has any bit.
  void demand_bits(std::uint32_t call, int argument, std::uint32_t mask) {
    judge(call, argument, BPF_JSET, mask, 1, 0);
  }
  /// Refuses the call unless the low half of the argument is `value`.
  void demand_value(std::uint32_t call, int argument, std::uint32_t value) {
    judge(call, argument, BPF_JEQ, value, 1, 0);
  }
  /// Refuses the call if the low half of the argument is `value`.
  void refuse_value(std::uint32_t call, int argument, std::uint32_t value) {
    judge(call, argument, BPF_JEQ, value, 0, 1);
  }

  bool install() {
    allow();
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
  }

 private:
  void add(int code, std::uint32_t k, int jump_true = 0, int jump_false = 0) {
    code_.push_back({static_cast<std::uint16_t>(code), static_cast<std::uint8_t>(jump_true),
                     static_cast<std::uint8_t>(jump_false), k});
  }
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
  void load_call() { load(offsetof(seccomp_data, nr)); }
  /// Little-endian: the low half comes first.
  void load_argument(int i) { load(offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(i)); }
  void jump(int kind, std::uint32_t value, int if_true, int if_false) {
    add(BPF_JMP | kind | BPF_K, value, if_true, if_false);
  }
  /// Compares an argument of the call; 1 passes over the refusal.
  void judge(std::uint32_t call, int argument, int kind, std::uint32_t value, int if_true, int if_false) {
    jump(BPF_JEQ, call, 0, 4);
    load_argument(argument);
    jump(kind, value, if_true, if_false);
    refuse(EPERM);
    allow();
  }
  void refuse(int reason) { add(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(reason)); }
  void allow() { add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW); }

  std::vector<sock_filter> code_;
};

void refuse_file_writes(Filter& filter) {
  constexpr std::uint32_t kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  for (const std::uint32_t call : kFileChanges) filter.refuse_call(call);
#ifdef SYS_open
  filter.refuse_bits(SYS_open, 1, kWriting);
#endif
  filter.refuse_bits(SYS_openat, 2, kWriting);
}

}  // namespace

bool filter_system_calls(FileWrites writes) {
  if (kArchitecture == 0) return false;
  Filter filter;
  for (const std::uint32_t call : kRefused) filter.refuse_call(call);
  if (writes == FileWrites::kNone) refuse_file_writes(filter);
  // The arguments of clone3() are out of a filter's sight; the C library then takes clone(), for threads alone.
  filter.refuse_call(SYS_clone3, ENOSYS);
  filter.demand_bits(SYS_clone, 0, CLONE_THREAD);
  const auto self = static_cast<std::uint32_t>(::getpid());
  for (const int call : {SYS_kill, SYS_tgkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo}) {
    filter.demand_value(static_cast<std::uint32_t>(call), 0, self);
  }
  filter.refuse_value(SYS_prctl, 0, PR_SET_PDEATHSIG);  // it would outlive us
  filter.demand_value(SYS_prlimit64, 2, 0);             // only asks
  return filter.install();
}

}  // namespace hallway
