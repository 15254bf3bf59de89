#include "runtime/program/interpreted_series.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/program/interpreter.hpp"
#include "runtime/program/program_series.hpp"
#include "runtime/taylor/program_layout.hpp"
#include "runtime/taylor/quadratic_targets.hpp"

namespace casimir {
namespace {

/// The functions of a casimir_series, from a program: by tables where all of its operations have
/// them, else line by line.
class InterpretedSeries {
 public:
  InterpretedSeries(const Program& program, std::size_t parameters,
                    std::optional<ProgramLayout>& layout)
      : program_(program),
        layout_(layout),
        parameters_(parameters),
        states_(program.outputs.size()),
        width_(series_width()),
        stride_((states_ + index(width_) - 1) / index(width_) * index(width_)),
        rows_(((CASIMIR_SERIES_ORDER + 2) * stride_ + kPart - 1) / kPart),
        rhs_(program),
        inputs_(program.inputs.size()),
        state_(states_) {}

  int width() const { return width_; }

  casimir_series functions() {
    casimir_series series = {};
    series.states = static_cast<int>(states_);
    series.object = this;
    series.rows = rows_[0].numbers;
    series.start = [](void* self, int order, const double* parameters) {
      static_cast<InterpretedSeries*>(self)->start(order, parameters);
    };
    series.begin = [](void* self, double t, const double* x) {
      static_cast<InterpretedSeries*>(self)->begin(t, x);
    };
    series.expand = [](void* self, double unit) {
      static_cast<InterpretedSeries*>(self)->expand(unit);
    };
    return series;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  /// Row 0 holds the rates, row k + 1 coefficient k.
  double* row(int i) { return rows_[0].numbers + index(i) * stride_; }

  void start(int order, const double* parameters) {
    order_ = order;
    std::copy_n(parameters, parameters_, inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
    if (layout_) return layout_->start(order, parameters);
    jet_.emplace(program_, Arithmetic<double>{},
                 std::vector<double>(parameters, parameters + parameters_), order);
  }

  void begin(double t, const double* x) {
    std::copy_n(x, states_, inputs_.begin());
    inputs_.back() = t;
    rhs_(inputs_.data(), row(0));
  }

  void expand(double unit) {
    if (layout_) return layout_->expand(inputs_.back(), unit, row(1), static_cast<int>(stride_));
    std::copy_n(inputs_.begin(), states_, state_.begin());
    const auto& series = jet_->expand(inputs_.back(), state_, unit);
    for (int k = 1; k <= order_; ++k) {
      double* const coefficient = row(k + 1);
      for (std::size_t i = 0; i < states_; ++i) coefficient[i] = series[i][index(k)];
    }
  }

  static constexpr std::size_t kPart = 8;
  struct alignas(64) Part {
    double numbers[kPart] = {};
  };

  const Program& program_;
  std::optional<ProgramLayout>& layout_;
  const std::size_t parameters_, states_;
  const int width_;
  const std::size_t stride_;  ///< numbers in a row
  std::vector<Part> rows_;
  Interpreter rhs_;
  std::vector<double> inputs_, state_;
  int order_ = 0;
  std::optional<TaylorJet<double>> jet_;
};

}  // namespace

std::function<ModuleFunctions::Integration> interpreted(const Program& rhs,
                                                        std::size_t parameters) {
  return [rhs, parameters, layout = ProgramLayout::of(rhs, parameters, series_width())](
             const casimir_run* run, double* x, casimir_outcome* out) mutable {
    if (rhs.outputs.size() > CASIMIR_SERIES_STATES)
      throw std::invalid_argument("a system of more than " + std::to_string(CASIMIR_SERIES_STATES) +
                                  " states is more than the method of Taylor series has room for");
    InterpretedSeries series(rhs, parameters, layout);
    const casimir_series functions = series.functions();
    integrate_series(functions, series.width(), run, x, out);
  };
}

}  // namespace casimir
