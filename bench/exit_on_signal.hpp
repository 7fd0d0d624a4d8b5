#pragma once

namespace rvbench::bench {

/// From now on Ctrl-C, SIGTERM and SIGHUP (the terminal is gone) end the process with the exit code
/// of an interrupt and a line on standard error, instead of by the signal. What has work to undo
/// puts StopOnSignal over it. A signal that the caller ignores (nohup) stays ignored.
///
/// Threads  before any other is started
void exit_on_signal();

}  // namespace rvbench::bench
