// Claims whose truth is known, at random, against the prover: see README.md.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/adversary/run.hpp"

int main(int argc, char** argv) {
  using namespace casimir::adversary;
  Request request;
  CLI::App app{"Judges what the prover says of random claims whose truth is known."};
  app.add_option("--count", request.count, "how many claims");
  app.add_option("--seed", request.seed, "of the random numbers");
  app.add_option("--first", request.first, "index of the first claim");
  app.add_option("--seconds", request.seconds, "of processor time, allowed for one claim");
  app.add_option("--show", request.show, "how many failures of one sort are shown");
  app.add_option("--family", request.family, "only claims of this family are counted");
  app.add_option("--shrink", request.shrink, "seconds for making a failing claim smaller");
  app.add_flag("--print", request.print, "prints the claims instead of judging them");
  app.add_option("--undecided", request.undecided,
                 "a file for the true claims that stay undecided");
  CLI11_PARSE(app, argc, argv);
  return run(request) ? 0 : 1;
}
