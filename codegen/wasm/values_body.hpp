#pragma once

#include <map>
#include <vector>

#include "codegen/wasm/module_writer.hpp"
#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir::codegen::wasm {

/// The functions that a module asks of the browser, by their operations.
using Imports = std::map<Op, int>;

/// Imports the functions of JavaScript's Math that the programs call.
Imports imported_functions(ModuleWriter& module, const std::vector<const Program*>& programs);

/// Adds the value of an operation; `first` and `second` add those of its operands.
template <class First, class Second>
void add_operation(Body& body, Op op, const Imports& imports, const First& first,
                   const Second& second) {
  first();
  switch (op) {
    case Op::add:
      second();
      body.add(Code::f64_add);
      break;
    case Op::sub:
      second();
      body.add(Code::f64_sub);
      break;
    case Op::mul:
      second();
      body.add(Code::f64_mul);
      break;
    case Op::div:
      second();
      body.add(Code::f64_div);
      break;
    case Op::neg:
      body.add(Code::f64_neg);
      break;
    case Op::sqrt:
      body.add(Code::f64_sqrt);
      break;
    case Op::abs:
      body.add(Code::f64_abs);
      break;
    case Op::sign:  // (a > 0) - (a < 0) + 0 a
      body.number(0).add(Code::f64_greater);
      first();
      body.number(0).add(Code::f64_less).add(Code::i32_sub).add(Code::f64_from_i32);
      first();  // 0 a, which is no number where a is none
      body.number(0).add(Code::f64_mul).add(Code::f64_add);
      break;
    case Op::pow:
    case Op::atan2:
      second();
      body.call(imports.at(op));
      break;
    default:
      body.call(imports.at(op));
  }
}

/// Evaluates a program at inputs in memory and writes its outputs there, one after the other.
/// \returns how many doubles it needs as locals: from number 0 on
/// \param limits  of the constants, see `codegen::constant_value`
int add_values(Body& body, const Program& program, const Imports& imports, int inputs, int outputs,
               const Limits& limits);

}  // namespace casimir::codegen::wasm
