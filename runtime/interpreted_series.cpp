#include "runtime/interpreted_series.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "runtime/interpreter.hpp"
#include "runtime/kernels/taylor.hpp"
#include "runtime/taylor_jet.hpp"

namespace casimir {
namespace {

using casimir_kernel::Lanes8;
constexpr int kWidth = 8, kMostBlocks = 8, kMostOrder = 24;

/// What the kernel asks of a series, from a program.
template <int the_blocks>
struct InterpretedSeries {
  using V = Lanes8;
  static constexpr int blocks = the_blocks;
  static constexpr bool smooth = false;

  const int states, order;
  V c[kMostOrder + 1][blocks] = {};
  V rate[blocks] = {};

  InterpretedSeries(const Program& program, const casimir_run* run, std::size_t parameters)
      : states(static_cast<int>(program.outputs.size())),
        order(casimir_kernel::taylor::order_for(run)),
        rhs_(program),
        inputs_(program.inputs.size()),
        state_(program.outputs.size()),
        rates_(program.outputs.size()),
        jet_(program, {}, {run->parameters, run->parameters + parameters}, order) {
    std::copy_n(run->parameters, parameters, inputs_.begin() + states);
  }

  void begin(double t, const V* x) {
    for (int i = 0; i < states; ++i)
      inputs_[static_cast<std::size_t>(i)] = x[i / kWidth][i % kWidth];
    inputs_.back() = t;
    rhs_(inputs_.data(), rates_.data());
    for (int i = 0; i < states; ++i)
      rate[i / kWidth][i % kWidth] = rates_[static_cast<std::size_t>(i)];
  }

  void expand(double unit) {
    std::copy_n(inputs_.begin(), states, state_.begin());
    const auto& series = jet_.expand(inputs_.back(), state_, unit);
    for (int i = 0; i < states; ++i) {
      for (int k = 0; k <= order; ++k)
        c[k][i / kWidth][i % kWidth] =
            series[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    }
  }

 private:
  Interpreter rhs_;
  std::vector<double> inputs_, state_, rates_;
  TaylorJet<double> jet_;
};

template <int blocks>
void integrate_interpreted(const Program& rhs, std::size_t parameters, const casimir_run* run,
                           double* x, casimir_outcome* out) {
  if constexpr (blocks > kMostBlocks) {
    throw std::invalid_argument("a system of more than 64 states needs a C++ compiler");
  } else {
    if (rhs.outputs.size() > blocks * kWidth)
      return integrate_interpreted<blocks + 1>(rhs, parameters, run, x, out);
    using Series = InterpretedSeries<blocks>;
    const auto series = std::make_unique<Series>(rhs, run, parameters);
    casimir_kernel::taylor::March<Series>(run, *series, x, out).go();
  }
}

}  // namespace

std::function<ModuleFunctions::Integration> interpreted(const Program& rhs,
                                                        std::size_t parameters) {
  return [rhs, parameters](const casimir_run* run, double* x, casimir_outcome* out) {
    integrate_interpreted<1>(rhs, parameters, run, x, out);
  };
}

}  // namespace casimir
