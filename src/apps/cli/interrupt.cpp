#include "apps/cli/interrupt.h"

#include <csignal>

#include "apps/cli/progress.h"
#include "core/files.h"

namespace lightwell {

namespace {

// SA_RESETHAND has put back what the system does by itself, so that whoever waits for us learns of the signal.
void clean_up(int signal) {
  discard_partial_files();
  Progress::erase_bar();
  ::raise(signal);
}

}  // namespace

void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    ::sigaction(signal, nullptr, &old);
    if (old.sa_handler == SIG_IGN) continue;  // nohup, and jobs in the background
    struct sigaction action {};
    action.sa_handler = clean_up;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
  ::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace lightwell
