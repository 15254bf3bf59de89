#pragma once

#include <functional>
#include <string>
#include <vector>

namespace casimir::tools {

/// A piece of work that a process of its own does: it may crash or hang without harm to others.
struct Job {
  /// Runs in the child, whose standard output and error are kept; its result is the exit status.
  /// It may replace the process by another program.
  std::function<int()> work;
  double longest = 0;  ///< seconds after which the child is killed
  /// It writes files: where this process is ended by a signal, it gets SIGTERM and is waited for.
  bool tidies = false;
};

/// What came of it.
struct Reply {
  int exit = -1;        ///< the exit status; -1: it did not exit by itself
  bool killed = false;  ///< because it took longer than it may
  std::string out, err;
};

/// Does all of the jobs, `at_once` at a time, and tells `done` of each reply in the order of their
/// ends. The children end with this process.
/// \param more  asked now and then: false ends those under way, as if they took too long, and
/// leaves
///              the rest undone; they get no reply.
/// \throws SystemError  if no process can be started.
void do_jobs(const std::vector<Job>& jobs, int at_once,
             const std::function<void(std::size_t job, const Reply& reply)>& done,
             const std::function<bool()>& more = {});

/// For a signal handler: ends the children that tidy up after themselves. Only async-signal-safe
/// calls.
void end_children() noexcept;

}  // namespace casimir::tools
