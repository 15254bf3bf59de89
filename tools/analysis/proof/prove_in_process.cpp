#include "tools/analysis/proof/prove_in_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>

#include "codegen/compile.hpp"
#include "symbolic/case/limits.hpp"
#include "tools/analysis/proof/proof_json.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

/// What the worker ends with where nobody listens any more.
constexpr int kUnheard = 1;

void send(int descriptor, const std::string& line) {
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t n = write(descriptor, line.data() + done, line.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(kUnheard);
    done += static_cast<std::size_t>(n);
  }
}

/// What is to be proved, of a flow or a map.
struct Work {
  std::function<std::vector<Proof>(const std::function<bool(const Proof&)>&)> run;
  std::function<std::vector<Proof>()> pending;
};

/// The key under which a line names the limit that was reached: the interface says it in the
/// reason.
constexpr const char* kLimitKey = "limit";

std::string line_of(const Proof& proof) {
  nlohmann::ordered_json json = to_json(proof);
  if (proof.limit != nullptr) json[kLimitKey] = name_of(proof.limit);
  return json.dump() + '\n';
}

Proof proof_of(const nlohmann::ordered_json& line) {
  Proof proof = proof_from_json(line);
  for (const LimitName& limit : limit_names())
    if (line.value(kLimitKey, "") == limit.name) proof.limit = limit.value;
  return proof;
}

/// The worker: one line of JSON for each proof. It dies with its parent and on Ctrl-C.
[[noreturn]] void work(int descriptor, const Work& proofs, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kUnheard);  // it had ended before
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  try {
    proofs.run([&](const Proof& proof) {
      send(descriptor, line_of(proof));
      return true;
    });
  } catch (const std::exception& problem) {
    send(descriptor, nlohmann::ordered_json{{"error", problem.what()}}.dump() + '\n');
  }
  _exit(0);
}

/// Reads lines until the worker ends or the time is up; false in the latter case.
bool read_lines(int descriptor, Clock::time_point deadline,
                const std::function<void(const std::string&)>& handle) {
  std::string buffer;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd waiting{descriptor, POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(std::min<long>(left, 1000)));
    if (ready < 0 && errno != EINTR) return true;
    if (ready <= 0) continue;
    char chunk[4096];
    const ssize_t n = read(descriptor, chunk, sizeof chunk);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    buffer.append(chunk, static_cast<std::size_t>(n));
    for (std::size_t end = buffer.find('\n'); end != std::string::npos; end = buffer.find('\n')) {
      handle(buffer.substr(0, end));
      buffer.erase(0, end + 1);
    }
  }
}

std::vector<Proof> within(double seconds, const Work& wanted,
                          const std::function<void(const Proof&)>& report) {
  if (seconds <= 0) {
    return wanted.run([&](const Proof& proof) {
      if (report) report(proof);
      return true;
    });
  }
  std::vector<Proof> proofs = wanted.pending();
  int ends[2];
  if (pipe(ends) != 0)
    throw EnvironmentError(fmt::format("cannot start a worker: {}", std::strerror(errno)));
  const pid_t parent = getpid();
  const pid_t worker = fork();
  if (worker < 0)
    throw EnvironmentError(fmt::format("cannot start a worker: {}", std::strerror(errno)));
  if (worker == 0) {
    close(ends[0]);
    work(ends[1], wanted, parent);
  }
  close(ends[1]);
  std::size_t done = 0;
  std::string error;
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(seconds));
  const bool finished = read_lines(ends[0], deadline, [&](const std::string& line) {
    const auto json = nlohmann::ordered_json::parse(line);
    if (json.contains("error")) {
      error = json.at("error");
      return;
    }
    if (done == proofs.size()) return;
    const bool fact = proofs[done].fact;
    const bool note = proofs[done].note;
    proofs[done] = proof_of(json);
    proofs[done].fact = fact;
    proofs[done].note = note;
    if (report) report(proofs[done]);
    ++done;
  });
  kill(worker, SIGKILL);
  close(ends[0]);
  while (waitpid(worker, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (!error.empty()) throw ModelError(error);
  for (; done < proofs.size(); ++done) {
    proofs[done].reason = finished ? "the worker process ended early: out of memory or killed"
                                   : fmt::format("the time limit of {} s was reached", seconds);
    if (report) report(proofs[done]);
  }
  return proofs;
}

}  // namespace

std::vector<Proof> prove_within(double seconds, const Model& model, const Candidates& candidates,
                                const std::function<void(const Proof&)>& report) {
  return within(seconds,
                {[&](const auto& each) { return prove(model, candidates, each); },
                 [&] { return pending(model, candidates); }},
                report);
}

std::vector<Proof> prove_within(double seconds, const MapModel& map, const Candidates& candidates,
                                const std::function<void(const Proof&)>& report) {
  return within(seconds,
                {[&](const auto& each) { return prove_map(map, candidates, each); },
                 [&] { return pending(map, candidates); }},
                report);
}

}  // namespace casimir
