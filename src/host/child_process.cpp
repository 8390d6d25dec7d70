#include "host/child_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>

#ifdef __linux__
#include <sys/prctl.h>
#endif

extern char** environ;

namespace whittle {
namespace {

// The programs that run; 0 where there is none. Beyond so many at a time the others are left to the
// system (PR_SET_PDEATHSIG).
constexpr int kMostPrograms = 16;
constexpr pid_t kTaken = -1, kKilled = -2;
std::atomic<pid_t> programs[kMostPrograms];
static_assert(std::atomic<pid_t>::is_always_lock_free);

/// A place in that list, taken before there is a program.
std::atomic<pid_t>* take_place() {
  for (std::atomic<pid_t>& place : programs) {
    pid_t expected = 0;
    if (place.compare_exchange_strong(expected, kTaken)) return &place;
  }
  return nullptr;
}

/// No signal comes to this thread while it lives.
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t all;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~WithoutSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_{};
};

bool open_as(int number, const char* path, int flags) {
  constexpr mode_t kOnlyMine = 0600;
  const int descriptor = ::open(path, flags, kOnlyMine);
  if (descriptor < 0 || descriptor == number) return descriptor >= 0;
  const bool done = ::dup2(descriptor, number) >= 0;
  ::close(descriptor);
  return done;
}

bool take_input(const ProgramSurroundings& surroundings) {
  const int given = surroundings.input_descriptor;
  if (given < 0) return open_as(STDIN_FILENO, surroundings.input.c_str(), O_RDONLY);
  // Where it is already that, it must only stay open.
  return given == STDIN_FILENO ? ::fcntl(given, F_SETFD, 0) == 0 : ::dup2(given, STDIN_FILENO) >= 0;
}

/// What happens in the child; if it returns, errno says why. Only what is allowed between fork and
/// exec where there are other threads. (posix_spawn would do all of it but PR_SET_PDEATHSIG.)
void become(const char* program, const char* const* arguments,
            const ProgramSurroundings& surroundings, pid_t parent, const sigset_t& signals) {
  ::setpgid(0, 0);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  // It may have gone before that was said.
  if (::getppid() != parent) ::_exit(1);
  if (!take_input(surroundings) ||
      !open_as(STDOUT_FILENO, surroundings.messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC) ||
      ::dup2(STDOUT_FILENO, STDERR_FILENO) < 0) {
    return;
  }
  const char* const folder = surroundings.folder.c_str();
  if (*folder != '\0' && ::chdir(folder) != 0) return;
  // The parent's handlers are not the child's; what is ignored stays so.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) ::signal(signal, SIG_DFL);
  }
  ::pthread_sigmask(SIG_SETMASK, &signals, nullptr);
  ::execve(program, const_cast<char* const*>(arguments), environ);
}

/// Starts it; its id, or -1 and the error number.
pid_t start(const char* program, const char* const* arguments,
            const ProgramSurroundings& surroundings, std::atomic<pid_t>* place, int& error) {
  // Closes when the program starts; else the error number comes through it.
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    error = errno;
    return -1;
  }
  const pid_t parent = ::getpid();
  pid_t child = -1;
  {
    const WithoutSignals quiet;
    child = ::fork();
    error = errno;
    if (child == 0) {
      become(program, arguments, surroundings, parent, quiet.before());
      error = errno;
      (void)!::write(ends[1], &error, sizeof error);
      ::_exit(1);
    }
    // By both, so that it is so for both from here on.
    if (child > 0) ::setpgid(child, child);
    if (child > 0 && place) *place = child;
  }
  ::close(ends[1]);
  int said = 0;
  ssize_t got = 0;
  while (child > 0 && (got = ::read(ends[0], &said, sizeof said)) < 0 && errno == EINTR) {
  }
  ::close(ends[0]);
  if (child > 0) error = got == sizeof said ? said : 0;
  return child;
}

}  // namespace

std::optional<int> run_program(const std::string& program, const char* const* arguments,
                               const ProgramSurroundings& surroundings, int& error) {
  std::atomic<pid_t>* const place = take_place();
  const pid_t child = start(program.c_str(), arguments, surroundings, place, error);
  siginfo_t ended{};
  // Not yet reaped: as long as it is in the list, or can be stopped, its id is its own.
  {
    const std::stop_callback stopped(surroundings.stop, [child] {
      if (child > 0) ::kill(-child, SIGKILL);
    });
    while (child > 0 && ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) != 0 &&
           errno == EINTR) {
    }
  }
  // Whoever kills programs ends this one too; nothing is to be said of how they ended.
  while (place && place->exchange(0) == kKilled) {
    *place = kKilled;
    ::pause();
  }
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0) {
    if (errno == EINTR) continue;
    error = errno;
    break;
  }
  return error == 0 ? std::optional(status) : std::nullopt;
}

void kill_programs() noexcept {
  const int saved = errno;
  for (std::atomic<pid_t>& place : programs) {
    pid_t child = place;
    // Fails where it has just ended by itself.
    if (child <= 0 || !place.compare_exchange_strong(child, kKilled)) continue;
    ::kill(-child, SIGKILL);
    siginfo_t ended{};
    while (::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) != 0 &&
           errno == EINTR) {
    }
  }
  errno = saved;
}

}  // namespace whittle
