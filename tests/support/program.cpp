#include "support/program.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace whittle {
namespace {

namespace fs = std::filesystem;

constexpr int kNotStarted = 127;

/// A file without a name, for one of the standard files.
int temporary_file() {
  char name[] = "/tmp/whittle-cli-XXXXXX";
  const int descriptor = ::mkstemp(name);
  if (descriptor < 0) std::abort();
  ::unlink(name);
  return descriptor;
}

std::string read_back(int descriptor) {
  std::string text;
  char buffer[65536];
  ::lseek(descriptor, 0, SEEK_SET);
  for (ssize_t got = 0; (got = ::read(descriptor, buffer, sizeof buffer)) > 0;)
    text.append(buffer, size_t(got));
  return text;
}

void limit(int resource, const std::optional<uint64_t>& bytes) {
  if (!bytes) return;
  const rlimit value{*bytes, *bytes};
  ::setrlimit(__rlimit_resource(resource), &value);
}

Ended wait_for(pid_t child) {
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  Ended run;
  constexpr uint64_t kUnit = 1024;  // Linux counts in kibibytes.
  run.peak_memory_bytes = uint64_t(usage.ru_maxrss) * kUnit;
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
  return run;
}

}  // namespace

pid_t ProgramTest::start(const std::vector<std::string>& arguments, const RunSettings& settings,
                         int in, int out, int err) const {
  std::vector<char*> words;
  std::string program = WHITTLE_PROGRAM;
  words.push_back(program.data());
  std::vector<std::string> copies = arguments;
  for (std::string& copy : copies) words.push_back(copy.data());
  words.push_back(nullptr);

  const pid_t child = ::fork();
  if (child != 0) return child;
  // Nobody is there who could close a window.
  ::unsetenv("DISPLAY");
  ::dup2(in, STDIN_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::dup2(out, STDOUT_FILENO);
  if (settings.out == StandardOutput::kClosed) ::close(STDOUT_FILENO);
  for (int other = 3; other < 64; ++other) ::close(other);
  // Whoever runs the tests may have said otherwise.
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
  // Ends what hangs; what is merely slow has time.
  constexpr unsigned kPatienceSeconds = 100;
  ::alarm(kPatienceSeconds);
  if (settings.obeys_permissions && ::geteuid() == 0) {
    // Root without these is its files' owner and no more.
    for (const int capability : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH}) {
      if (::prctl(PR_CAPBSET_DROP, capability, 0, 0, 0) != 0) ::_exit(kNotStarted);
    }
  }
  limit(RLIMIT_AS, settings.memory_limit);
  limit(RLIMIT_FSIZE, settings.file_limit);
  if (::chdir(folder_.path().c_str()) == 0) ::execv(program.c_str(), words.data());
  ::_exit(kNotStarted);
}

Ended ProgramTest::run(const std::vector<std::string>& arguments,
                       const RunSettings& settings) const {
  const int in = temporary_file(), err = temporary_file();
  if (::write(in, settings.in.data(), settings.in.size()) != ssize_t(settings.in.size()))
    std::abort();
  ::lseek(in, 0, SEEK_SET);
  int out = -1;
  if (settings.out == StandardOutput::kDevFull) {
    out = ::open("/dev/full", O_WRONLY);
  } else if (settings.out == StandardOutput::kClosedPipe) {
    int ends[2];
    if (::pipe(ends) != 0) std::abort();
    ::close(ends[0]);
    out = ends[1];
  } else {
    out = temporary_file();
  }
  Ended run = wait_for(start(arguments, settings, in, out, err));
  if (settings.out == StandardOutput::kCaptured) run.out = read_back(out);
  run.err = read_back(err);
  for (const int descriptor : {in, out, err}) ::close(descriptor);
  return run;
}

Ended ProgramTest::run_and_signal(const std::vector<std::string>& arguments, int signal,
                                  int after_microseconds) const {
  return run_and_signal(arguments, signal, [=] { ::usleep(useconds_t(after_microseconds)); });
}

Ended ProgramTest::run_and_signal(const std::vector<std::string>& arguments, int signal,
                                  const std::function<void()>& wait) const {
  const int nowhere = ::open("/dev/null", O_RDWR);
  const pid_t child = start(arguments, {}, nowhere, nowhere, nowhere);
  wait();
  ::kill(child, signal);
  ::close(nowhere);
  return wait_for(child);
}

void ProgramTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string ProgramTest::read(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  EXPECT_TRUE(file.is_open()) << name << " is not there";
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> ProgramTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace whittle
