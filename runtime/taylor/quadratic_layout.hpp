#pragma once

#include <optional>
#include <vector>

#include "runtime/kernels/taylor/quadratic_tables.h"
#include "runtime/kernels/taylor/wide_tables.h"
#include "runtime/taylor/quadratic_form.hpp"

namespace casimir {

/// The layout for one register of states: as few registers of products as possible, and of those
/// layouts one with few products that must be moved. Nothing if there are more than 8 states or
/// more products than the tables hold. Always the same for the same form.
std::optional<casimir_quadratic> narrow_tables(const QuadraticForm& form);

/// The layout for several registers of states. Always the same for the same form.
class WideTables {
 public:
  /// \param width  lanes of a register: 2, 4 or 8.
  /// \throws std::invalid_argument  if the form has more than CASIMIR_WIDE_STATES states or
  ///                                CASIMIR_WIDE_PRODUCTS products, or its states fit one register
  ///                                of four or eight, for which there is no kernel.
  WideTables(const QuadraticForm& form, int width);

  /// The tables as the kernels read them; they live as long as this object does.
  casimir_wide view() const;

 private:
  /// Numbers that begin where a register of any width may begin.
  template <class Number>
  class Registers {
   public:
    void resize(std::size_t count) { parts_.resize((count + 7) / 8); }
    void append(const std::vector<Number>& lanes);
    Number* data() { return parts_.empty() ? nullptr : parts_[0].lanes; }
    const Number* data() const { return parts_.empty() ? nullptr : parts_[0].lanes; }
    int count() const { return static_cast<int>(used_); }

   private:
    struct alignas(64) Part {
      Number lanes[8] = {};
    };
    std::vector<Part> parts_;
    std::size_t used_ = 0;
  };

  friend class WideLayout;
  int states_ = 0, width_ = 0, blocks_ = 0, registers_ = 0;
  Registers<long long> left_, right_, linear_state_, moved_lane_;
  Registers<double> constant_, dense_, linear_factor_, own_factor_, moved_factor_;
  std::vector<int> linear_begin_, own_begin_, own_from_, moved_begin_, moved_from_;
};

}  // namespace casimir
