#include "codegen/emit_wasm.hpp"

#include <algorithm>

#include "codegen/optimise/lower.hpp"
#include "codegen/wasm/series_bodies.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"

namespace casimir {
namespace {

using namespace codegen::wasm;

/// (order) -> (): coefficients up to that order.
Body expand_body(int begin, int extend, int advance) {
  constexpr int kEnd = 0, kAt = 1;
  Body body;
  body.call(begin).integer(0).call(advance);
  body.get(kEnd).integer(kDouble).add(Code::i32_mul).set(kEnd);
  body.integer(kDouble).tee(kAt).get(kEnd).add(Code::i32_less).open(Code::if_).open(Code::loop);
  body.get(kAt).call(extend).get(kAt).call(advance);
  body.get(kAt).integer(kDouble).add(Code::i32_add).tee(kAt);
  body.get(kEnd).add(Code::i32_less).again();
  return body.add(Code::end).add(Code::end);
}

void add_evaluation(ModuleWriter& module, const char* name, const Program& program,
                    const Imports& imports, int inputs, int outputs, const Limits& limits) {
  Body body;
  const int locals = add_values(body, program, imports, inputs, outputs, limits);
  module.exported(name, module.function({}, {{locals, Type::f64}}, body));
}

/// Its outputs are the rates alone.
Program rates_of(Program flow, std::size_t states) {
  flow.outputs.resize(states);
  flow.output_names.resize(states);
  return codegen::without_dead_code(flow);
}

}  // namespace

WasmSeries emit_wasm(const Program& whole, std::size_t states, const Program& values, int order,
                     const Limits& limits) {
  constexpr std::size_t kMostLines = 20000;
  const Program flow = codegen::without_dead_code(whole);
  if (flow.code.size() + values.code.size() > kMostLines)
    throw ModelError("the equations are too long for a page");
  WasmSeries result;
  result.order = order;
  result.stride = kDouble * (order + 2);
  int free = 0;
  const auto places = [&](std::size_t count) {
    const int begin = free;
    free += kDouble * static_cast<int>(count);
    return begin;
  };
  result.inputs = places(flow.inputs.size());
  result.unit = places(1);
  result.rates = places(states);
  result.values = places(values.outputs.size());
  result.states = places(0);

  ModuleWriter module;
  const Imports imports = imported_functions(module, {&flow, &values});
  const SeriesSums sums = add_sums(module);
  const SeriesBodies bodies(flow, states,
                            {result.inputs, result.unit, result.states, result.stride}, imports,
                            sums, limits);
  const Signature of_order{{Type::i32}, {}};
  const int begin = module.function({}, {}, bodies.begin());
  const int extend = module.function(of_order, {}, bodies.extend());
  const int advance = module.function(of_order, {{2, Type::f64}}, bodies.advance());
  module.exported("prepare", module.function({}, {}, bodies.prepare()));
  module.exported("expand",
                  module.function(of_order, {{1, Type::i32}}, expand_body(begin, extend, advance)));
  add_evaluation(module, "rates", rates_of(flow, states), imports, result.inputs, result.rates,
                 limits);
  add_evaluation(module, "evaluate", values, imports, result.inputs, result.values, limits);
  for (std::size_t i = states; i < flow.outputs.size(); ++i)
    result.followed.push_back(bodies.place(flow.outputs[i]));
  result.singular = bodies.singular();
  result.kinks = bodies.kinks();
  result.needs_comparison = bodies.needs_comparison();
  result.bytes = module.bytes(static_cast<std::size_t>(bodies.end()));
  return result;
}

Program side_by_side(const Program& first, const Program& second) {
  Program result = first;
  const auto lines = static_cast<int>(first.code.size());
  const auto constants = static_cast<int>(first.constants.size());
  result.constants.insert(result.constants.end(), second.constants.begin(), second.constants.end());
  for (Instruction line : second.code) {
    if (line.op == Op::constant) {
      line.a += constants;
    } else if (line.op != Op::input && line.op != Op::pi) {
      line.a += lines;
      if (line.b >= 0) line.b += lines;
    }
    result.code.push_back(line);
  }
  for (const int output : second.outputs) result.outputs.push_back(output + lines);
  result.output_names.insert(result.output_names.end(), second.output_names.begin(),
                             second.output_names.end());
  return result;
}

}  // namespace casimir
