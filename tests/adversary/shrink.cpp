#include "tests/adversary/shrink.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>

#include "tests/adversary/templates.hpp"

namespace casimir::adversary {
namespace {

using Clock = std::chrono::steady_clock;

Case& base_of(AnyClaim& claim) {
  if (auto* search = std::get_if<SearchCase>(&claim)) return search->base;
  if (auto* planted = std::get_if<PlantedCase>(&claim)) return planted->base;
  return std::get<Case>(claim);
}

/// All expressions that a claim may do with others in their place. The level is not among them
/// where its parts are written down.
std::vector<Expr*> expressions_of(AnyClaim& claim) {
  Case& c = base_of(claim);
  std::vector<Expr*> list;
  // A planted structure would not be there any more.
  if (std::holds_alternative<PlantedCase>(claim)) return list;
  const auto add = [&](auto& named) {
    for (auto& n : named) list.push_back(&n.value);
  };
  if (c.system.bracket != Bracket::none) list.push_back(&c.system.hamiltonian);
  for (Expr& e : c.system.equations) list.push_back(&e);
  for (auto& [place, entry] : c.system.entries) list.push_back(&entry);
  add(c.system.definitions);
  add(c.casimirs);
  add(c.integrals);
  for (auto* claims : {&c.conditionals, &c.invariant_relations}) {
    for (OnLevel& on : *claims) {
      list.push_back(&on.expression);
      for (std::size_t i = 0; i < on.on.size() && c.pieces.empty(); ++i) list.push_back(&on.on[i]);
    }
  }
  for (IdentityClaim& i : c.identities) {
    list.push_back(&i.left);
    list.push_back(&i.right);
  }
  for (Lax& pair : c.lax) {
    for (Matrix* m : {&pair.l, &pair.a})
      for (auto& row : *m)
        for (Expr& e : row) list.push_back(&e);
  }
  for (Measure& m : c.measures) list.push_back(&m.density);
  for (Map& m : c.maps)
    for (Expr& e : m.expressions) list.push_back(&e);
  return list;
}

/// The expression with one of its parts replaced by something smaller, in all ways.
std::vector<Expr> smaller(const Expr& e) {
  std::vector<Expr> result;
  const Node& node = e.node();
  if (node.op == Op::number && (e.is(0) || e.is(1))) return result;
  for (const long number : {0L, 1L}) result.emplace_back(number);
  if (node.op == Op::number) return result;
  result.insert(result.end(), node.arguments.begin(), node.arguments.end());
  for (std::size_t i = 0; i < node.arguments.size(); ++i) {
    for (const Expr& part : smaller(node.arguments[i])) {
      std::vector<Expr> arguments = node.arguments;
      arguments[i] = part;
      result.push_back(Expr::make(node.op, std::move(arguments), node.name));
    }
  }
  return result;
}

/// The claim without one thing that it may not need, in all ways.
std::vector<AnyClaim> with_less(const AnyClaim& claim) {
  std::vector<AnyClaim> result;
  const auto without = [&](const std::function<void(Case&, std::size_t)>& remove,
                           std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      result.push_back(claim);
      remove(base_of(result.back()), i);
    }
  };
  AnyClaim copy = claim;
  const Case& c = base_of(copy);
  const auto erase = [](auto& list, std::size_t i) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
  };
  without([&](Case& own, std::size_t i) { erase(own.casimirs, i); }, c.casimirs.size());
  without([&](Case& own, std::size_t i) { erase(own.integrals, i); }, c.integrals.size());
  without([&](Case& own, std::size_t i) { erase(own.system.domain, i); }, c.system.domain.size());
  without([&](Case& own, std::size_t i) { erase(own.system.definitions, i); },
          c.system.definitions.size());
  without([&](Case& own, std::size_t i) { erase(own.system.parameters, i); },
          c.system.parameters.size());
  return result;
}

/// In a child, which is killed when its time is up: that is `broken`, as a crash is.
Outcome judged_apart(const AnyClaim& claim, std::uint64_t seed, std::uint64_t index,
                     double seconds) {
  int ends[2];
  if (pipe(ends) != 0) return Outcome::unconfirmed;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const char outcome = static_cast<char>(judge(claim, seed, index).outcome);
    _exit(write(ends[1], &outcome, 1) == 1 ? 0 : 1);
  }
  close(ends[1]);
  Outcome result = Outcome::broken;
  if (child > 0) {
    pollfd wait{ends[0], POLLIN, 0};
    char outcome = 0;
    if (poll(&wait, 1, static_cast<int>(seconds * 1000)) > 0 && read(ends[0], &outcome, 1) == 1)
      result = static_cast<Outcome>(outcome);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  close(ends[0]);
  return child > 0 ? result : Outcome::unconfirmed;
}

std::string written(AnyClaim& claim) {
  if (const auto* search = std::get_if<SearchCase>(&claim)) return search->text();
  if (const auto* planted = std::get_if<PlantedCase>(&claim)) return planted->text();
  return base_of(claim).text();
}

}  // namespace

std::string shrunk(std::uint64_t seed, std::uint64_t index, Outcome outcome, double seconds) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  Random generator(seed, index);
  AnyClaim best = random_claim(generator);
  const double each = seconds / 10;
  const auto is_alike = [&](AnyClaim& candidate) {
    return Clock::now() < end && judged_apart(candidate, seed, index, each) == outcome;
  };
  for (bool better = true; better && Clock::now() < end;) {
    better = false;
    for (AnyClaim& candidate : with_less(best)) {
      if (!is_alike(candidate)) continue;
      best = std::move(candidate);
      better = true;
      break;
    }
    const std::size_t count = expressions_of(best).size();
    for (std::size_t i = 0; i < count && Clock::now() < end; ++i) {
      for (const Expr& part : smaller(*expressions_of(best)[i])) {
        AnyClaim candidate = best;
        *expressions_of(candidate)[i] = part;
        if (written(candidate).size() >= written(best).size() || !is_alike(candidate)) continue;
        best = std::move(candidate);
        better = true;
        break;
      }
    }
  }
  return written(best);
}

}  // namespace casimir::adversary
