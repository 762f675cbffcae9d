#include "mesher/sandbox.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <poll.h>
#include <sched.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>
#include <string>

#include "base/error.hpp"
#include "base/log.hpp"

namespace dygita {

namespace {

void limit(__rlimit_resource resource, rlim_t value) {
  const rlimit both = {value, value};
  setrlimit(resource, &both);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DYGITA_HAS_SHADOW
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DYGITA_HAS_SHADOW
#endif
#endif

void limit_memory(double bytes) {
#ifdef DYGITA_HAS_SHADOW
  (void)bytes;  // the sanitizer's shadow takes terabytes of addresses
#else
  if (bytes > 0.0) limit(RLIMIT_AS, static_cast<rlim_t>(bytes));
#endif
}

// A filter of system calls.
class Filter {
 public:
  Filter() : context_(seccomp_init(SCMP_ACT_ALLOW)) {}
  ~Filter() { seccomp_release(context_); }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  void refuse(std::initializer_list<int> calls, int error = EPERM) {
    for (const int call : calls) check(seccomp_rule_add(context_, SCMP_ACT_ERRNO(error), call, 0));
  }
  void refuse_where(int call, scmp_arg_cmp argument) {
    check(seccomp_rule_add_array(context_, SCMP_ACT_ERRNO(EACCES), call, 1, &argument));
  }
  void load() { check(seccomp_load(context_)); }

 private:
  static void check(int failed) {
    if (failed == 0) return;
    throw InputError(
        "the system refuses the filter (seccomp) that prevents gmsh from starting programs and writing files\n    "
        "--trust-mesh FILE reads a trusted file without it");
  }

  scmp_filter_ctx context_;
};

// Opening for writing, by the flags at a place among the arguments.
void refuse_writing(Filter& filter, int call, unsigned place) {
  for (const unsigned long flag : {O_WRONLY, O_RDWR, O_CREAT, O_TRUNC, O_APPEND})
    filter.refuse_where(call, {place, SCMP_CMP_MASKED_EQ, flag, flag});
}

void filter_calls() {
  Filter filter;
  filter.refuse({SCMP_SYS(execve), SCMP_SYS(execveat), SCMP_SYS(fork), SCMP_SYS(vfork), SCMP_SYS(ptrace),
                 SCMP_SYS(kill), SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev), SCMP_SYS(pidfd_open),
                 SCMP_SYS(pidfd_send_signal), SCMP_SYS(bpf), SCMP_SYS(keyctl), SCMP_SYS(add_key),
                 SCMP_SYS(perf_event_open), SCMP_SYS(unshare), SCMP_SYS(setns), SCMP_SYS(mount), SCMP_SYS(chroot)});
  filter.refuse({SCMP_SYS(socket), SCMP_SYS(socketpair), SCMP_SYS(connect), SCMP_SYS(bind), SCMP_SYS(listen),
                 SCMP_SYS(sendto), SCMP_SYS(sendmsg), SCMP_SYS(sendmmsg), SCMP_SYS(io_uring_setup)});
  filter.refuse({SCMP_SYS(unlink),    SCMP_SYS(unlinkat),    SCMP_SYS(rename),
                 SCMP_SYS(renameat),  SCMP_SYS(renameat2),   SCMP_SYS(mkdir),
                 SCMP_SYS(mkdirat),   SCMP_SYS(rmdir),       SCMP_SYS(link),
                 SCMP_SYS(linkat),    SCMP_SYS(symlink),     SCMP_SYS(symlinkat),
                 SCMP_SYS(mknod),     SCMP_SYS(mknodat),     SCMP_SYS(truncate),
                 SCMP_SYS(ftruncate), SCMP_SYS(creat),       SCMP_SYS(chmod),
                 SCMP_SYS(fchmod),    SCMP_SYS(fchmodat),    SCMP_SYS(chown),
                 SCMP_SYS(fchown),    SCMP_SYS(lchown),      SCMP_SYS(fchownat),
                 SCMP_SYS(utimensat), SCMP_SYS(utime),       SCMP_SYS(utimes),
                 SCMP_SYS(futimesat), SCMP_SYS(setxattr),    SCMP_SYS(lsetxattr),
                 SCMP_SYS(fsetxattr), SCMP_SYS(removexattr), SCMP_SYS(open_by_handle_at)},
                EACCES);
  // Whose flags a filter cannot see: the C library continues with the older call.
  filter.refuse({SCMP_SYS(clone3), SCMP_SYS(openat2)}, ENOSYS);
  filter.refuse_where(SCMP_SYS(clone), {0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0});
  filter.refuse_where(SCMP_SYS(ioctl), {1, SCMP_CMP_EQ, TIOCSTI, 0});
  refuse_writing(filter, SCMP_SYS(open), 1);
  refuse_writing(filter, SCMP_SYS(openat), 2);
  filter.load();
}

// What libraries look at while they work: their own files, the processors, random numbers. Of /proc nothing of any
// process.
constexpr const char* of_the_system[] = {"/usr",          "/lib",          "/lib64",      "/etc/ld.so.cache",
                                         "/dev/null",     "/dev/urandom",  "/dev/random", "/sys/devices/system/cpu",
                                         "/proc/cpuinfo", "/proc/meminfo", "/proc/stat"};

void let_read(int set, const char* path) {
  const int opened = ::open(path, O_PATH | O_CLOEXEC);
  if (opened < 0) return;
  struct stat found {};
  landlock_path_beneath_attr rule = {};
  rule.parent_fd = opened;
  rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
  if (fstat(opened, &found) == 0 && S_ISDIR(found.st_mode)) rule.allowed_access |= LANDLOCK_ACCESS_FS_READ_DIR;
  syscall(SYS_landlock_add_rule, set, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  close(opened);
}

// What the kernel knows of is handled, and nothing of it allowed but reading some.
void restrict_files(const std::vector<std::string>& readable) {
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) {  // an old kernel: the filter has to do
    warn("this kernel has no Landlock: a mesh file can make gmsh read any file that you can read");
    return;
  }
  landlock_ruleset_attr rules = {};
  rules.handled_access_fs = LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                            LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                            LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
                            LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM |
                            LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
  const long set = syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0);
  if (set < 0) return;
  for (const char* path : of_the_system) let_read(static_cast<int>(set), path);
  for (const std::string& path : readable) let_read(static_cast<int>(set), path.c_str());
  syscall(SYS_landlock_restrict_self, set, 0);
  close(static_cast<int>(set));
}

// A parent that died before PR_SET_PDEATHSIG sends no signal any more: its end of standard error is closed then.
bool is_orphan() {
  pollfd errors{STDERR_FILENO, 0, 0};
  return poll(&errors, 1, 0) > 0 && (errors.revents & (POLLHUP | POLLERR)) != 0;
}

}  // namespace

void confine(double memory, const std::vector<std::string>& readable) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (is_orphan()) _exit(1);
  limit(RLIMIT_CORE, 0);
  limit_memory(memory);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  restrict_files(readable);
  filter_calls();
}

}  // namespace dygita
