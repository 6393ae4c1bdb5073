#include "collision/sandbox/system_call_filter.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace twinarm {
namespace {

#ifdef __x86_64__
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
constexpr long kForbiddenHere[] = {__NR_fork,   __NR_vfork, __NR_creat,  __NR_unlink, __NR_rename,
                                   __NR_rmdir,  __NR_mkdir, __NR_link,   __NR_chmod,  __NR_chown,
                                   __NR_lchown, __NR_mknod, __NR_symlink};
#else
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
constexpr long kForbiddenHere[] = {__NR_renameat};
#endif
constexpr long kForbidden[] = {
    // processes
    __NR_execve, __NR_execveat, __NR_clone, __NR_clone3, __NR_ptrace, __NR_kill,
    __NR_process_vm_readv, __NR_process_vm_writev, __NR_pidfd_getfd,
    // connections
    __NR_socket, __NR_socketpair, __NR_connect, __NR_bind, __NR_listen, __NR_accept, __NR_accept4,
    __NR_sendto, __NR_sendmsg,
    // files
    __NR_openat2, __NR_unlinkat, __NR_renameat2, __NR_mkdirat, __NR_linkat, __NR_symlinkat,
    __NR_mknodat, __NR_fchmod, __NR_fchmodat, __NR_fchown, __NR_fchownat, __NR_truncate,
    __NR_setxattr, __NR_utimensat, __NR_mount, __NR_umount2, __NR_chroot, __NR_pivot_root,
    // the kernel
    __NR_bpf, __NR_io_uring_setup, __NR_perf_event_open, __NR_userfaultfd, __NR_keyctl,
    __NR_unshare, __NR_setns};

// A program of the kernel's packet filter (seccomp(2), "Filters").
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    unless_equal(kArchitecture, 0, 1);  // of another architecture: other numbers
    end(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
  }
  void forbid(long call) {
    unless_equal(static_cast<std::uint32_t>(call), 1, 0);
    end(kRefuse);
  }
  // Unless it only reads; its flags are the argument of that index.
  void forbid_writing(long call, std::size_t flags) {
    unless_equal(static_cast<std::uint32_t>(call), 5, 0);
    load(offsetof(seccomp_data, args) + 8 * flags);  // the lower half
    add(BPF_ALU | BPF_AND | BPF_K, O_ACCMODE | O_CREAT | O_TRUNC);
    unless_equal(O_RDONLY, 1, 0);
    end(SECCOMP_RET_ALLOW);
    end(kRefuse);
  }
  void install() {
    end(SECCOMP_RET_ALLOW);
    sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
  }

 private:
  static constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;

  void add(int code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
    code_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
  }
  void load(std::size_t offset) {
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
  }
  // Skips so many instructions.
  void unless_equal(std::uint32_t value, std::uint8_t if_other, std::uint8_t if_equal) {
    add(BPF_JMP | BPF_JEQ | BPF_K, value, if_equal, if_other);
  }
  void end(std::uint32_t how) { add(BPF_RET | BPF_K, how); }

  std::vector<sock_filter> code_;
};

}  // namespace

void forbid_side_effects() {
  Filter filter;
  for (const long call : kForbiddenHere) filter.forbid(call);
  for (const long call : kForbidden) filter.forbid(call);
#ifdef __x86_64__
  filter.forbid_writing(__NR_open, 1);
#endif
  filter.forbid_writing(__NR_openat, 2);
  filter.install();
}

}  // namespace twinarm
