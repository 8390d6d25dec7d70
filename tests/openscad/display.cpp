#include "display.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace whittle {

Display::Display() {
  int ends[2];
  if (::pipe(ends) != 0) return;
  server_ = ::fork();
  if (server_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      ::dup2(nowhere, descriptor);
    const std::string number = std::to_string(ends[1]);
    ::execl(WHITTLE_XVFB, WHITTLE_XVFB, "-displayfd", number.c_str(), "-screen", "0", "640x480x24",
            "-nolisten", "tcp", nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  // The server writes its number when it is ready.
  std::string number;
  for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
  ::close(ends[0]);
  if (!number.empty()) name_ = ":" + number;
}

Display::~Display() {
  if (server_ <= 0) return;
  ::kill(server_, SIGTERM);
  ::waitpid(server_, nullptr, 0);
}

}  // namespace whittle
