#include "tools/cli/children.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <list>

#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// A child on its way, and the ends of the pipes that it writes to.
struct Child {
  std::size_t job;
  pid_t process;
  std::array<int, 2> pipes;  ///< of its standard output and error; -1: at its end
  Clock::time_point end;
  Reply reply = {};

  bool writes() const { return pipes[0] >= 0 || pipes[1] >= 0; }
};

constexpr std::size_t kMostTidy = 256;
std::array<std::atomic<pid_t>, kMostTidy> g_tidy;  ///< processes; 0: none

/// Exchanges one entry for another, if there is one.
void exchange_tidy(pid_t old, pid_t now) {
  for (std::atomic<pid_t>& process : g_tidy) {
    pid_t expected = old;
    if (process.compare_exchange_strong(expected, now)) return;
  }
}

[[noreturn]] void be_child(const Job& job, const std::array<int, 2>& out,
                           const std::array<int, 2>& err, pid_t parent) {
  for (std::atomic<pid_t>& process : g_tidy) process = 0;  // those of the parent
  if (!job.tidies) {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }
  prctl(PR_SET_PDEATHSIG, job.tidies ? SIGTERM : SIGKILL);
  if (getppid() != parent) _exit(127);  // it had ended before
  dup2(out[1], STDOUT_FILENO);
  dup2(err[1], STDERR_FILENO);
  for (const int end : {out[0], out[1], err[0], err[1]}) close(end);
  int status = 127;
  try {
    status = job.work();
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
  }
  std::cout.flush();
  std::cerr.flush();
  std::fflush(nullptr);
  _exit(status);
}

Child begin(const std::vector<Job>& jobs, std::size_t number) {
  std::array<int, 2> out = {-1, -1}, err = {-1, -1};
  if (pipe(out.data()) != 0 || pipe(err.data()) != 0)
    throw SystemError(fmt::format("no pipe: {}", std::strerror(errno)));
  std::cout.flush();
  std::fflush(nullptr);  // what waits to be written must not be written twice
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw SystemError(fmt::format("no new process: {}", std::strerror(errno)));
  if (child == 0) be_child(jobs[number], out, err, parent);
  if (jobs[number].tidies) exchange_tidy(0, child);
  close(out[1]);
  close(err[1]);
  const auto longest = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(jobs[number].longest));
  return {number, child, {out[0], err[0]}, Clock::now() + longest};
}

/// Takes what the children have written, waiting a little for it.
void listen(std::list<Child>& children) {
  constexpr int kMilliseconds = 50;
  std::vector<pollfd> ends;
  for (const Child& child : children)
    for (const int end : child.pipes) ends.push_back({end, POLLIN, 0});
  if (poll(ends.data(), ends.size(), kMilliseconds) <= 0) return;
  std::size_t next = 0;
  for (Child& child : children) {
    for (std::size_t i = 0; i < child.pipes.size(); ++i, ++next) {
      if (ends[next].revents == 0) continue;
      std::array<char, 65536> text = {};
      const ssize_t length = read(child.pipes[i], text.data(), text.size());
      if (length < 0 && errno == EINTR) continue;
      if (length > 0) {
        (i == 0 ? child.reply.out : child.reply.err)
            .append(text.data(), static_cast<std::size_t>(length));
      } else {
        close(child.pipes[i]);
        child.pipes[i] = -1;
      }
    }
  }
}

void stop_late_ones(std::list<Child>& children) {
  for (Child& child : children) {
    if (child.reply.killed || Clock::now() < child.end) continue;
    kill(child.process, SIGKILL);
    child.reply.killed = true;
    // A grandchild that holds the pipes must not hold us.
    for (int& end : child.pipes) {
      if (end >= 0) close(end);
      end = -1;
    }
  }
}

void bury(Child& child) {
  int status = 0;
  while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
  }
  exchange_tidy(child.process, 0);
  if (WIFEXITED(status)) child.reply.exit = WEXITSTATUS(status);
}

}  // namespace

void do_jobs(const std::vector<Job>& jobs, int at_once,
             const std::function<void(std::size_t job, const Reply& reply)>& done,
             const std::function<bool()>& more) {
  std::list<Child> children;
  for (std::size_t next = 0; next < jobs.size() || !children.empty();) {
    if (more && !more()) {
      next = jobs.size();
      for (Child& child : children) child.end = Clock::now();
    }
    while (next < jobs.size() && children.size() < static_cast<std::size_t>(at_once))
      children.push_back(begin(jobs, next++));
    listen(children);
    stop_late_ones(children);
    for (auto child = children.begin(); child != children.end();) {
      if (child->writes()) {
        ++child;
        continue;
      }
      bury(*child);
      done(child->job, child->reply);
      child = children.erase(child);
    }
  }
}

void end_children() noexcept {
  for (const std::atomic<pid_t>& process : g_tidy)
    if (const pid_t child = process; child > 0) kill(child, SIGTERM);
  for (const std::atomic<pid_t>& process : g_tidy)
    if (const pid_t child = process; child > 0) waitpid(child, nullptr, 0);
}

}  // namespace casimir::tools
