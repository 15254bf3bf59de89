#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace casimir {

/// $CASIMIR_INSTRUCTIONS asks for what there is not, or not here; the text says what there is.
class InstructionsUnavailable : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The instruction sets that kernels and generated code are made for, by the width of a register.
enum class InstructionSet { baseline, avx2, avx512 };

/// As $CASIMIR_INSTRUCTIONS names it. The baseline of x86 is SSE2, elsewhere what the processor is.
inline std::string name_of(InstructionSet set) {
  if (set == InstructionSet::avx512) return "avx512";
  if (set == InstructionSet::avx2) return "avx2";
#ifdef __x86_64__
  return "sse2";
#else
  return "baseline";
#endif
}

/// Those that this processor runs, widest first. Never empty.
inline std::vector<InstructionSet> instruction_sets_here() {
  std::vector<InstructionSet> result;
#ifdef __x86_64__
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    result.push_back(InstructionSet::avx512);
  if (avx2) result.push_back(InstructionSet::avx2);
#endif
  result.push_back(InstructionSet::baseline);
  return result;
}

/// \param name  "avx512", "avx2" or "sse2".
/// \throws InstructionsUnavailable  if that is none of them, or this processor does not run it.
inline InstructionSet instruction_set_named(const std::string& name) {
  std::string known;
  for (const InstructionSet set : instruction_sets_here()) {
    if (name == name_of(set)) return set;
    known += (known.empty() ? "" : ", ") + name_of(set);
  }
  for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2}) {
    if (name == name_of(set))
      throw InstructionsUnavailable("CASIMIR_INSTRUCTIONS is '" + name +
                                    "', which this processor does not run; it runs " + known);
  }
  throw InstructionsUnavailable("CASIMIR_INSTRUCTIONS is '" + name +
                                "', which is no instruction set; those of this processor are " +
                                known);
}

/// What $CASIMIR_INSTRUCTIONS asks for; without it, the widest that this processor runs.
/// \throws InstructionsUnavailable
inline InstructionSet chosen_instruction_set() {
  const char* const asked = std::getenv("CASIMIR_INSTRUCTIONS");
  return asked && *asked ? instruction_set_named(asked) : instruction_sets_here().front();
}

}  // namespace casimir
