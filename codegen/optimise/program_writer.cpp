#include "codegen/optimise/program_writer.hpp"

#include <algorithm>

namespace casimir::codegen {

int ProgramWriter::number(const cln::cl_RA& value) {
  const auto [place, is_new] =
      constants_.try_emplace(value, static_cast<int>(program_.constants.size()));
  if (is_new) program_.constants.push_back(value);
  return emit(Op::constant, place->second);
}

int ProgramWriter::emit(Op op, int a, int b) {
  const bool commutes = op == Op::add || op == Op::mul;
  const auto key =
      commutes ? std::make_tuple(op, std::min(a, b), std::max(a, b)) : std::make_tuple(op, a, b);
  const auto [place, is_new] = known_.try_emplace(key, static_cast<int>(program_.code.size()));
  if (is_new) program_.code.push_back({op, a, b});
  return place->second;
}

int ProgramWriter::power(int base, int exponent) {
  if (exponent == 1) return base;
  if (exponent % 2 == 1) return emit(Op::mul, base, power(base, exponent - 1));
  const int half = power(base, exponent / 2);
  return emit(Op::mul, half, half);
}

const cln::cl_RA* ProgramWriter::constant(int i) const {
  return at(i).op == Op::constant ? &program_.constants[static_cast<std::size_t>(at(i).a)]
                                  : nullptr;
}

bool ProgramWriter::is_zero(int i) const { return constant(i) && *constant(i) == 0; }

bool ProgramWriter::is_one(int i) const { return constant(i) && *constant(i) == 1; }

int ProgramWriter::sum(int a, int b) {
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  if (constant(a) && constant(b)) return number(*constant(a) + *constant(b));
  if (is_negation(b)) return difference(a, at(b).a);
  if (is_negation(a)) return difference(b, at(a).a);
  return emit(Op::add, a, b);
}

int ProgramWriter::difference(int a, int b) {
  if (a == b) return number(0);
  if (is_zero(a)) return negation(b);
  if (is_zero(b)) return a;
  if (constant(a) && constant(b)) return number(*constant(a) - *constant(b));
  if (is_negation(b)) return sum(a, at(b).a);
  return emit(Op::sub, a, b);
}

int ProgramWriter::product(int a, int b) {
  if (is_zero(a) || is_zero(b)) return number(0);
  if (is_one(a)) return b;
  if (is_one(b)) return a;
  if (constant(a) && constant(b)) return number(*constant(a) * *constant(b));
  if (is_negation(a)) return negation(product(at(a).a, b));
  if (is_negation(b)) return negation(product(a, at(b).a));
  if (constant(a) && *constant(a) == -1) return negation(b);
  if (constant(b) && *constant(b) == -1) return negation(a);
  return emit(Op::mul, a, b);
}

int ProgramWriter::quotient(int a, int b) {
  if (is_zero(a) && !is_zero(b)) return a;
  if (is_one(b)) return a;
  if (constant(a) && constant(b) && !is_zero(b)) return number(*constant(a) / *constant(b));
  if (is_negation(a)) return negation(quotient(at(a).a, b));
  return emit(Op::div, a, b);
}

int ProgramWriter::negation(int a) {
  if (const cln::cl_RA* value = constant(a)) return number(-*value);
  if (is_negation(a)) return at(a).a;
  return emit(Op::neg, a);
}

}  // namespace casimir::codegen
