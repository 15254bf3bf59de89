#include "runtime/program/interpreted_radau.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

#include "runtime/kernels/one_step/radau.hpp"
#include "runtime/program/interpreter.hpp"

namespace casimir {
namespace {

/// A system as programs, and the run that is made of it. The kernel gets it in place of the
/// parameters.
class InterpretedSystem {
 public:
  InterpretedSystem(const Program& rhs, const JacobianProgram& jacobian)
      : states_(rhs.outputs.size()),
        rhs_(rhs),
        jacobian_(jacobian.program),
        entries_(jacobian.entries),
        inputs_(rhs.inputs.size()),
        values_(jacobian.entries.size()) {}

  std::size_t states() const { return states_; }

  void set_parameters(const double* parameters) {
    if (parameters)
      std::copy_n(parameters, inputs_.size() - states_ - 1, inputs_.begin() + offset(states_));
  }

  void rates(double t, const double* x, double* dx) {
    take(t, x);
    rhs_(inputs_.data(), dx);
  }

  /// By columns of `rows` entries each; only those that are not identically zero are written.
  void differentiate(double t, const double* x, double* J, int rows) {
    take(t, x);
    jacobian_(inputs_.data(), values_.data());
    for (std::size_t k = 0; k < entries_.size(); ++k)
      J[entries_[k].second * rows + entries_[k].first] = values_[k];
  }

 private:
  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  void take(double t, const double* x) {
    std::copy_n(x, states_, inputs_.begin());
    inputs_.back() = t;
  }

  std::size_t states_;
  Interpreter rhs_, jacobian_;
  std::vector<std::pair<int, int>> entries_;
  std::vector<double> inputs_, values_;
};

/// What kernels are compiled for: so many components, of which those behind the states stay zero.
template <int room>
struct Roomy {
  static constexpr int n = room;
  static InterpretedSystem& self(const double* p) {
    return *static_cast<InterpretedSystem*>(const_cast<void*>(static_cast<const void*>(p)));
  }
  static void rhs(double t, const double* x, const double* p, double* dx) {
    std::fill_n(dx, room, 0.);
    self(p).rates(t, x, dx);
  }
  static void jacobian(double t, const double* x, const double* p, double* J) {
    std::fill_n(J, room * room, 0.);
    self(p).differentiate(t, x, J, room);
  }
};

/// Stands between a kernel for `room` components and a caller who knows of fewer.
template <int room>
class Between {
 public:
  Between(const casimir_run& asked, InterpretedSystem& system)
      : asked_(asked), run_(asked), states_(static_cast<int>(system.states())) {
    // The kernel hands the parameters on and does not look at them.
    run_.parameters = static_cast<const double*>(static_cast<const void*>(&system));
    run_.solver = this;
    run_.factor = [](void* self, int which, int size, const double* matrix) {
      return static_cast<Between*>(self)->factor(which, size, matrix);
    };
    run_.solve = [](void* self, int which, double* b) {
      static_cast<Between*>(self)->solve(which, b);
    };
    run_.observer = run_.looker = this;
    if (asked.observe)
      run_.observe = [](void* self, const casimir_step* step) {
        const auto* own = static_cast<Between*>(self);
        return own->shown(*step, [&](const casimir_step* seen) {
          return own->asked_.observe(own->asked_.observer, seen);
        });
      };
    if (asked.look)
      run_.look = [](void* self, const casimir_step* step) {
        const auto* own = static_cast<Between*>(self);
        return own->shown(*step, [&](const casimir_step* seen) {
          return own->asked_.look(own->asked_.looker, seen);
        });
      };
  }

  template <int stages>
  void integrate(double* x, casimir_outcome* out) {
    std::array<double, room> state = {};
    std::copy_n(x, states_, state.begin());
    casimir_kernel::radau::integrate<Roomy<room>, stages>(&run_, state.data(), out);
    std::copy_n(state.begin(), states_, x);
  }

 private:
  struct Whole {
    const casimir_step* step;
    int states;
  };

  /// The same step to somebody who has room for the states only.
  template <class See>
  auto shown(const casimir_step& step, const See& see) const {
    const Whole whole{&step, states_};
    casimir_step seen = step;
    seen.data = &whole;
    seen.dense = [](const casimir_step* at, double t, double* x) {
      const auto& [known, count] = *static_cast<const Whole*>(at->data);
      std::array<double, room> state;
      known->dense(known, t, state.data());
      std::copy_n(state.begin(), count, x);
    };
    return see(&seen);
  }

  /// A matrix is made of blocks of `room` rows and columns: of each the part that is not trivial.
  int factor(int which, int size, const double* matrix) {
    const int blocks = size / room, part = blocks * states_;
    blocks_[static_cast<std::size_t>(which)] = blocks;
    packed_.resize(static_cast<std::size_t>(part) * static_cast<std::size_t>(part));
    double* to = packed_.data();
    for (int q = 0; q < blocks; ++q)
      for (int d = 0; d < states_; ++d)
        for (int r = 0; r < blocks; ++r)
          to = std::copy_n(matrix + (q * room + d) * size + r * room, states_, to);
    return asked_.factor(asked_.solver, which, part, packed_.data());
  }

  void solve(int which, double* b) {
    const int blocks = blocks_[static_cast<std::size_t>(which)];
    right_.resize(static_cast<std::size_t>(blocks * states_));
    for (int q = 0; q < blocks; ++q)
      std::copy_n(b + q * room, states_, right_.begin() + q * states_);
    asked_.solve(asked_.solver, which, right_.data());
    for (int q = 0; q < blocks; ++q)
      std::copy_n(right_.begin() + q * states_, states_, b + q * room);
  }

  const casimir_run& asked_;
  casimir_run run_;
  int states_;
  std::array<int, CASIMIR_MATRICES> blocks_ = {};
  std::vector<double> packed_, right_;
};

template <int room>
void run_in(InterpretedSystem& system, int stages, const casimir_run& run, double* x,
            casimir_outcome* out) {
  Between<room> between(run, system);
  if (stages == 3)
    between.template integrate<3>(x, out);
  else
    between.template integrate<5>(x, out);
}

}  // namespace

std::function<ModuleFunctions::Integration> interpreted_radau(const Program& rhs,
                                                              const JacobianProgram& jacobian,
                                                              int stages) {
  const std::size_t states = rhs.outputs.size();
  if (stages != 3 && stages != 5)
    throw std::invalid_argument("the interpreted Radau methods have 3 or 5 stages");
  if (states > kMostInterpretedStiff)
    throw std::invalid_argument("the interpreted Radau methods have no room for so many states");
  auto system = std::make_shared<InterpretedSystem>(rhs, jacobian);
  return [system, states, stages](const casimir_run* run, double* x, casimir_outcome* out) {
    system->set_parameters(run->parameters);
    const auto integrate = states <= 4    ? run_in<4>
                           : states <= 8  ? run_in<8>
                           : states <= 12 ? run_in<12>
                           : states <= 16 ? run_in<16>
                           : states <= 20 ? run_in<20>
                           : states <= 24 ? run_in<24>
                           : states <= 32 ? run_in<32>
                           : states <= 40 ? run_in<40>
                                          : run_in<51>;
    integrate(*system, stages, *run, x, out);
  };
}

}  // namespace casimir
