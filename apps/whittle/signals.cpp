#include "signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

#include "host/child_process.h"
#include "host/pending_files.h"

namespace whittle {
namespace {

extern "C" void clean_up_and_end(int signal) {
  // First what could make such files again.
  kill_programs();
  remove_pending_files();
  // The default action was restored on the way here.
  ::raise(signal);
}

}  // namespace

void prepare_for_interruption() {
  // The lowest free number is taken, so this fills the gaps; reading where one should write, and
  // the other way round, fails as it should.
  for (int i = 0; i < 3; ++i) {
    if (::fcntl(i, F_GETFD) < 0) (void)::open("/dev/null", i == 0 ? O_WRONLY : O_RDONLY);
  }
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  for (const int interruption : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    action.sa_handler = clean_up_and_end;
    action.sa_flags = SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    struct sigaction before {};
    ::sigaction(interruption, nullptr, &before);
    // A program started by nohup, or in the background of a script, is not to be interrupted.
    if (before.sa_handler != SIG_IGN) ::sigaction(interruption, &action, nullptr);
  }
}

}  // namespace whittle
