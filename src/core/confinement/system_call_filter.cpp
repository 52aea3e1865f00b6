#include "system_call_filter.hpp"

#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace passo {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;  // filter_system_calls() fails
#endif
static_assert(std::endian::native == std::endian::little, "the filter reads the low halves of arguments");

constexpr std::uint32_t newest_call = 450;  // set_mempolicy_home_node, Linux 5.17
constexpr int set_own_signal = 10;          // F_SETSIG
constexpr int set_owner_ex = 15;            // F_SETOWN_EX

// Refused with EPERM whatever the arguments are.
constexpr int refused[] = {
    // The network.
    __NR_socket, __NR_connect, __NR_bind, __NR_listen, __NR_io_uring_setup, __NR_io_uring_enter, __NR_io_uring_register,
// Changes of files outside its folder that Landlock does not cover on every kernel.
#ifdef __NR_chmod
    __NR_chmod, __NR_chown, __NR_lchown, __NR_utime, __NR_utimes, __NR_futimesat,
#endif
    __NR_fchmod, __NR_fchmodat, __NR_fchown, __NR_fchownat, __NR_utimensat, __NR_truncate, __NR_setxattr,
    __NR_lsetxattr, __NR_fsetxattr, __NR_removexattr, __NR_lremovexattr, __NR_fremovexattr, __NR_name_to_handle_at,
    __NR_open_by_handle_at, __NR_inotify_add_watch, __NR_fanotify_init, __NR_quotactl,
    // Other processes.
    __NR_ptrace, __NR_process_vm_readv, __NR_process_vm_writev, __NR_kcmp, __NR_pidfd_open, __NR_pidfd_getfd,
    __NR_pidfd_send_signal, __NR_process_madvise, __NR_rt_sigqueueinfo, __NR_rt_tgsigqueueinfo, __NR_setpriority,
    __NR_sched_setparam, __NR_sched_setscheduler, __NR_sched_setattr, __NR_sched_setaffinity, __NR_ioprio_set,
    __NR_migrate_pages, __NR_move_pages, __NR_shmget, __NR_shmat, __NR_shmctl, __NR_msgget, __NR_msgsnd, __NR_msgrcv,
    __NR_msgctl, __NR_semget, __NR_semop, __NR_semctl, __NR_semtimedop, __NR_mq_open, __NR_mq_unlink, __NR_add_key,
    __NR_request_key, __NR_keyctl,
    // The system.
    __NR_unshare, __NR_setns, __NR_mount, __NR_umount2, __NR_pivot_root, __NR_chroot, __NR_fsopen, __NR_fsmount,
    __NR_open_tree, __NR_move_mount, __NR_mount_setattr, __NR_bpf, __NR_perf_event_open, __NR_userfaultfd,
    __NR_init_module, __NR_finit_module, __NR_delete_module, __NR_kexec_load, __NR_reboot, __NR_swapon, __NR_swapoff,
    __NR_acct, __NR_settimeofday, __NR_clock_settime, __NR_adjtimex, __NR_clock_adjtime, __NR_sethostname,
    __NR_setdomainname, __NR_syslog, __NR_vhangup};

class Filter {
 public:
  void load(std::uint32_t offset) { add(BPF_LD | BPF_W | BPF_ABS, offset, 0, 0); }
  void load_argument(unsigned number) {
    load(static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 8 * std::size_t{number}));
  }
  void answer(std::uint32_t action) { add(BPF_RET | BPF_K, action, 0, 0); }
  void keep_bits(std::uint32_t bits) { add(BPF_ALU | BPF_AND | BPF_K, bits, 0, 0); }
  void refuse(int error) { answer(SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error)); }
  // If the loaded value is (or has, or is greater than) `value`, the next `count` instructions are executed; else they
  // are skipped.
  void if_equal(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, count); }
  void unless_equal(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JEQ | BPF_K, value, count, 0); }
  void if_has(std::uint32_t bits, std::uint8_t count) { add(BPF_JMP | BPF_JSET | BPF_K, bits, 0, count); }
  void if_greater(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JGT | BPF_K, value, 0, count); }

  bool install() {
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  void add(unsigned code, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
    code_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
  }
  std::vector<sock_filter> code_;
};

// Allows a call if its argument is this process.
void only_for_this_process(Filter& filter, int call, bool zero_is_this_process) {
  filter.if_equal(static_cast<std::uint32_t>(call), zero_is_this_process ? 6 : 4);
  filter.load_argument(0);
  if (zero_is_this_process) {
    filter.if_equal(0, 1);
    filter.answer(SECCOMP_RET_ALLOW);
  }
  filter.if_equal(static_cast<std::uint32_t>(getpid()), 1);
  filter.answer(SECCOMP_RET_ALLOW);
  filter.refuse(EPERM);
}

void no_other_processes(Filter& filter) {
#ifdef __NR_fork
  for (const int call : {__NR_fork, __NR_vfork}) {
    filter.if_equal(static_cast<std::uint32_t>(call), 1);
    filter.refuse(EPERM);
  }
#endif
  // Threads are allowed.
  filter.if_equal(__NR_clone, 4);
  filter.load_argument(0);
  filter.if_has(CLONE_THREAD, 1);
  filter.answer(SECCOMP_RET_ALLOW);
  filter.refuse(EPERM);
  for (const int call : {__NR_kill, __NR_tkill, __NR_tgkill}) only_for_this_process(filter, call, false);
}

}  // namespace

bool filter_system_calls(bool may_start_processes) {
  if (architecture == 0) {
    errno = ENOSYS;
    return false;
  }
  Filter filter;
  filter.load(offsetof(seccomp_data, arch));
  filter.unless_equal(architecture, 1);
  filter.answer(SECCOMP_RET_KILL_PROCESS);
  filter.load(offsetof(seccomp_data, nr));
  filter.if_greater(newest_call, 1);  // those of x32 are greater, too
  filter.refuse(ENOSYS);
  for (const int call : refused) {
    filter.if_equal(static_cast<std::uint32_t>(call), 1);
    filter.refuse(EPERM);
  }
  // Its flags are in memory, where no filter sees them. The C library then calls clone().
  filter.if_equal(__NR_clone3, 1);
  filter.refuse(ENOSYS);
  only_for_this_process(filter, __NR_prlimit64, true);
  // A pair of streams reaches nobody else; one of datagrams can send to any address.
  filter.if_equal(__NR_socketpair, 5);
  filter.load_argument(1);
  filter.keep_bits(~static_cast<std::uint32_t>(SOCK_CLOEXEC | SOCK_NONBLOCK));
  filter.if_equal(SOCK_STREAM, 1);
  filter.answer(SECCOMP_RET_ALLOW);
  filter.refuse(EPERM);
  if (!may_start_processes) no_other_processes(filter);
  // The owner of a file descriptor gets a signal of the program's choice.
  filter.if_equal(__NR_fcntl, 8);
  filter.load_argument(1);
  for (const int command : {F_SETOWN, set_own_signal, set_owner_ex}) {
    filter.if_equal(static_cast<std::uint32_t>(command), 1);
    filter.refuse(EPERM);
  }
  filter.answer(SECCOMP_RET_ALLOW);
  filter.answer(SECCOMP_RET_ALLOW);
  return filter.install();
}

}  // namespace passo
