#include "tests/adversary/worker.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

namespace casimir::adversary {
namespace {

void put(std::string& message, const std::string& field) {
  const std::uint32_t size = static_cast<std::uint32_t>(field.size());
  message.append(reinterpret_cast<const char*>(&size), sizeof size).append(field);
}

std::string message_of(const Judgement& j) {
  std::string message;
  message.push_back(static_cast<char>(j.outcome));
  message.push_back(static_cast<char>(j.kind));
  message.push_back(static_cast<char>(j.truth));
  for (const std::string& field : {j.family, j.what, j.file}) put(message, field);
  return message;
}

void write_all(int pipe, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(pipe, bytes.data() + done, bytes.size() - done);
    if (n <= 0) _exit(1);
    done += static_cast<std::size_t>(n);
  }
}

/// A child that judges claims from `first` on and writes what it finds into a pipe.
class Worker {
 public:
  Worker(const Request& request, std::uint64_t first) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    std::fflush(nullptr);
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("no process");
    if (child_ == 0) {
      close(ends[0]);
      for (std::uint64_t i = first; i < request.first + request.count; ++i)
        write_all(ends[1], message_of(judge(request.seed, i)));
      _exit(0);
    }
    close(ends[1]);
    pipe_ = ends[0];
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    close(pipe_);
  }

  /// What it says next; nothing if it died or is too slow.
  std::optional<Judgement> next(double seconds) {
    Judgement j;
    char head[3];
    if (!wait(seconds) || !read_all(head, sizeof head)) return std::nullopt;
    j.outcome = static_cast<Outcome>(head[0]);
    j.kind = static_cast<Kind>(head[1]);
    j.truth = static_cast<Truth>(head[2]);
    for (std::string* field : {&j.family, &j.what, &j.file}) {
      std::uint32_t size = 0;
      if (!read_all(reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
      field->resize(size);
      if (!read_all(field->data(), size)) return std::nullopt;
    }
    return j;
  }

  /// Of what it ended; only after `next` had nothing.
  std::string end() {
    int status = 0;
    if (waitpid(child_, &status, WNOHANG) == 0) return "no answer in time";
    return WIFSIGNALED(status) ? std::string("killed by ") + strsignal(WTERMSIG(status))
                               : "it exited";
  }

 private:
  /// Seconds of processor time, since a busy machine makes no claim hard; but who waits for ever
  /// uses none.
  bool wait(double seconds) {
    constexpr double kBusy = 30;
    const double before = processor_time();
    pollfd poll_for{pipe_, POLLIN, 0};
    for (double waited = 0; poll(&poll_for, 1, 1000) == 0; waited += 1) {
      if (!(processor_time() - before < seconds) || waited > kBusy * seconds) return false;
    }
    return true;
  }

  /// Of the child, in seconds; infinite where it cannot be told.
  double processor_time() const {
    clockid_t clock;
    timespec time{};
    if (clock_getcpuclockid(child_, &clock) != 0 || clock_gettime(clock, &time) != 0)
      return std::numeric_limits<double>::infinity();
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  bool read_all(char* to, std::size_t size) {
    while (size > 0) {
      const ssize_t n = read(pipe_, to, size);
      if (n <= 0) {
        usleep(20000);  // until the end of the child can be asked for
        return false;
      }
      to += n;
      size -= static_cast<std::size_t>(n);
    }
    return true;
  }

  pid_t child_ = 0;
  int pipe_ = -1;
};

Judgement broken(const Request& request, std::uint64_t index, const std::string& how) {
  Judgement j = unjudged(request.seed, index);
  j.outcome = Outcome::broken;
  j.what = how;
  return j;
}

}  // namespace

void judge_all(const Request& request,
               const std::function<void(std::uint64_t index, const Judgement&)>& report) {
  std::uint64_t index = request.first;
  const std::uint64_t end = request.first + request.count;
  while (index < end) {
    Worker worker(request, index);
    while (index < end) {
      const auto judgement = worker.next(request.seconds);
      report(index, judgement ? *judgement : broken(request, index, worker.end()));
      ++index;
      if (!judgement) break;
    }
  }
}

}  // namespace casimir::adversary
