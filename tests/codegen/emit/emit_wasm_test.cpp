// WebAssembly of a right-hand side: what the pages integrate with. Their numbers are tested in a
// browser (`live_page_test.py`).
#include "codegen/emit_wasm.hpp"

#include <gtest/gtest.h>

namespace casimir::test {
namespace {

/// x' = c x, with the constant in the first line or behind the state.
Program growth(bool constant_first) {
  Program flow;
  flow.inputs = {"x", "t"};
  flow.constants = {1, 2, 3, 4, 5, 6, 7};
  const Instruction constant{Op::constant, 6, -1}, state{Op::input, 0, -1};
  flow.code = {
      constant_first ? constant : state, constant_first ? state : constant, {Op::mul, 0, 1}};
  flow.outputs = {2};
  flow.output_names = {"dx"};
  return flow;
}

TEST(EmitWasm, AConstantMayBeTheFirstLine) {
  for (const bool first : {false, true}) {
    const WasmSeries series = emit_wasm(growth(first), 1, growth(first), 8, {});
    ASSERT_GT(series.bytes.size(), 8U);
    EXPECT_EQ(std::string(series.bytes.begin() + 1, series.bytes.begin() + 4), "asm");
    EXPECT_EQ(series.order, 8);
  }
}

}  // namespace
}  // namespace casimir::test
