#include "passo/confinement/confinement.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "system_call_filter.hpp"
#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace passo {
namespace {

// Landlock as in the kernel's documentation, userspace-api/landlock. Debian 12's headers lack its newer parts.
constexpr long create_ruleset = 444;  // the same numbers on all processors
constexpr long add_rule = 445;
constexpr long restrict_self = 446;
constexpr unsigned ask_version = 1;
constexpr unsigned rule_path_beneath = 1;

struct Ruleset {
  std::uint64_t files = 0;
  std::uint64_t network = 0;
  std::uint64_t scopes = 0;
};
struct [[gnu::packed]] PathRule {
  std::uint64_t allowed = 0;
  std::int32_t parent = -1;
};

constexpr std::uint64_t execute = 1U << 0;
constexpr std::uint64_t write_file = 1U << 1;
constexpr std::uint64_t read_file = 1U << 2;
constexpr std::uint64_t read_folder = 1U << 3;
constexpr std::uint64_t truncate_file = 1U << 14;
constexpr std::uint64_t all_of_version_1 = (1U << 13) - 1;
constexpr std::uint64_t of_files = execute | write_file | read_file | truncate_file;

int landlock_version() {
  return static_cast<int>(syscall(create_ruleset, nullptr, 0, ask_version));
}

Ruleset ruleset_of(int version) {
  Ruleset ruleset{.files = all_of_version_1};
  if (version >= 2) ruleset.files |= 1U << 13;  // linking and renaming between folders
  if (version >= 3) ruleset.files |= truncate_file;
  if (version >= 4) ruleset.network = 3;        // bind and connect by TCP
  if (version >= 5) ruleset.files |= 1U << 15;  // ioctl of devices
  if (version >= 6) ruleset.scopes = 3;         // abstract sockets, signals
  return ruleset;
}

Failure<std::string> failure(const std::string& what) {
  return {what + ": " + std::strerror(errno)};
}

// A missing file needs no rule.
bool allow(int ruleset, const std::string& path, std::uint64_t rights) {
  const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
  if (file < 0) return true;
  struct stat found {};
  if (fstat(file, &found) == 0 && !S_ISDIR(found.st_mode)) rights &= of_files;
  const PathRule rule{rights, file};
  const bool done = syscall(add_rule, ruleset, rule_path_beneath, &rule, 0) == 0;
  close(file);
  return done;
}

Status<std::string> confine_files(const Confinement& confinement) {
  const Ruleset handled = ruleset_of(landlock_version());
  const int ruleset = static_cast<int>(syscall(create_ruleset, &handled, sizeof handled, 0));
  if (ruleset < 0) return failure("Landlock");
  bool done = allow(ruleset, confinement.folder, handled.files) && allow(ruleset, "/dev/null", read_file | write_file);
  for (const std::string& path : system_folders()) {
    done = done && allow(ruleset, path, execute | read_file | read_folder);
  }
  for (const std::string& path : confinement.readable) {
    done = done && allow(ruleset, path, execute | read_file | read_folder);
  }
  done = done && syscall(restrict_self, ruleset, 0) == 0;
  if (!done) return failure("Landlock");
  close(ruleset);
  return Unit{};
}

// Root without capabilities is a user like others; with no_new_privs, execve() does not give them back.
bool drop_privileges() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  const __user_cap_data_struct none[2] = {};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && syscall(SYS_capset, &header, none) == 0;
}

void limit(decltype(RLIMIT_CPU) what, std::uint64_t most, std::uint64_t hard) {
  const rlimit bound{most, hard};
  setrlimit(what, &bound);
}

}  // namespace

void limit_resources(const ResourceLimits& limits) {
  limit(RLIMIT_CORE, 0, 0);
  if (limits.processor_seconds != 0) limit(RLIMIT_CPU, limits.processor_seconds, limits.processor_seconds + 1);
  if (limits.memory != 0) limit(RLIMIT_AS, limits.memory, limits.memory);
  if (limits.file_size != 0) limit(RLIMIT_FSIZE, limits.file_size, limits.file_size);
}

const std::vector<std::string>& system_folders() {
  static const std::vector<std::string> folders = {"/usr",      "/bin",        "/sbin",
                                                   "/lib",      "/lib32",      "/lib64",
                                                   "/libx32",   "/nix/store",  "/etc/ld.so.cache",
                                                   "/dev/zero", "/dev/random", "/dev/urandom"};
  return folders;
}

Status<std::string> check_confinement() {
  if (landlock_version() < 1) {
    return Failure{std::string("this kernel has no Landlock (Linux 5.13 or later, with landlock in its list lsm=)")};
  }
  if (prctl(PR_GET_SECCOMP, 0, 0, 0, 0) < 0) return Failure{std::string("this kernel has no seccomp filters")};
  return Unit{};
}

Status<std::string> confine(const Confinement& confinement) {
  if (Status<std::string> can = check_confinement(); !can) return can;
  if (!drop_privileges()) return failure("dropping privileges");
  if (Status<std::string> files = confine_files(confinement); !files) return files;
  if (!filter_system_calls(confinement.may_start_processes)) return failure("the filter of system calls");
  return Unit{};
}

}  // namespace passo
