// What happens when the user interrupts the program.
#pragma once

namespace lightwell {

// From now on SIGINT, SIGTERM and SIGHUP first remove files that are half written and the progress bar. A file that
// grows beyond the system's limit is an error of the write, no signal.
void handle_signals();

}  // namespace lightwell
