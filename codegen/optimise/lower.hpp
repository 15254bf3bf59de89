#pragma once

#include <string>
#include <vector>

#include "codegen/optimise/terms.hpp"
#include "runtime/program.hpp"

namespace casimir::codegen {

/// Operations that a run performs; what depends on constants alone is free.
struct OperationCount {
  int mul = 0;
  int add = 0;  ///< additions, subtractions and changes of sign
  int div = 0;
  int calls = 0;  ///< square roots and elementary functions
  friend bool operator==(const OperationCount&, const OperationCount&) = default;
};

OperationCount count_operations(const Program& program);

/// Rough processor time of one evaluation, in multiplications.
int weight(const OperationCount& count);

/// For each instruction, whether it is free of inputs: a number, known when the code is written.
std::vector<bool> constant_instructions(const Program& program);

/// Writes a system out as straight-line code: every value once, integer powers by squaring, sums
/// beginning with a positive term. Only what the outputs need.
Program lowered(const TermSystem& system, const std::vector<std::string>& inputs,
                const std::vector<std::string>& outputs);

/// The same program without the instructions that no output needs. The inputs stay.
Program without_dead_code(const Program& program);

/// The program of one of its outputs alone. \param k  among them, from 0
Program single_output(const Program& program, std::size_t k);

}  // namespace casimir::codegen
