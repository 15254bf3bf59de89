#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "codegen/compile.hpp"
#include "codegen/compile/compiler.hpp"
#include "codegen/specialise.hpp"
#include "symbolic/case_file.hpp"
#include "tests/folder.hpp"

namespace casimir::testing {

/// The Kovalevskaya top, as text of a case file.
inline const char* const kKovalevskaya = R"toml(
title = "Kovalevskaya top"
source = "Borisov & Mamaev, Rigid Body Dynamics, Sec. 2.4"
hamiltonian = "(M1^2 + M2^2 + 2*M3^2)/2 - r*g1"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[parameters]
r = { assume = "r != 0" }
[casimirs]
F1 = "g1^2 + g2^2 + g3^2"
F2 = "M1*g1 + M2*g2 + M3*g3"
[integrals]
K = "(M1^2 - M2^2 + 2*r*g1)^2 + (2*M1*M2 + 2*r*g2)^2"
[[scene]]
name = "default"
parameters = { r = "1" }
initial = { M1 = "1", M2 = "1/2", M3 = "1/3", g1 = "3/5", g2 = "0", g3 = "4/5" }
duration = "100"
)toml";

inline Model model_of(const std::string& toml, const std::string& file = "kovalevskaya.toml") {
  return build_model(parse_case(toml, file));
}

inline Specialisation specialised(const std::string& toml, const SpecialiseOptions& options = {}) {
  const Model model = model_of(toml);
  return specialise(model, model.scenes.at(0), options);
}

/// A case of plain equations over one parameter list, for short tests.
inline std::string equations(const std::vector<std::pair<std::string, std::string>>& field,
                             const std::string& rest = "") {
  std::string names;
  std::string lines;
  std::string initial;
  for (const auto& [name, rate] : field) {
    names += (names.empty() ? "\"" : ", \"") + name + "\"";
    lines += name + " = \"" + rate + "\"\n";
    initial += (initial.empty() ? "" : ", ") + name + " = \"1/2\"";
  }
  const bool has_scene = rest.find("[[scene]]") != std::string::npos;
  return "title = \"t\"\nsource = \"s\"\n[phase_space]\nvariables = [" + names +
         "]\n[equations]\n" + lines + rest +
         (has_scene ? "\ninitial = { " + initial + " }\nduration = \"1\"\n"
                    : "\n[[scene]]\nname = \"default\"\ninitial = { " + initial +
                          " }\nduration = \"1\"\n");
}

/// A program without functions, evaluated exactly.
inline std::vector<cln::cl_RA> exact(const Program& program,
                                     const std::vector<cln::cl_RA>& inputs) {
  std::vector<cln::cl_RA> values;
  const auto at = [&](int i) { return values[static_cast<std::size_t>(i)]; };
  for (const Instruction& c : program.code) {
    switch (c.op) {
      case Op::input:
        values.push_back(inputs[static_cast<std::size_t>(c.a)]);
        break;
      case Op::constant:
        values.push_back(program.constants[static_cast<std::size_t>(c.a)]);
        break;
      case Op::add:
        values.push_back(at(c.a) + at(c.b));
        break;
      case Op::sub:
        values.push_back(at(c.a) - at(c.b));
        break;
      case Op::mul:
        values.push_back(at(c.a) * at(c.b));
        break;
      case Op::div:
        values.push_back(at(c.a) / at(c.b));
        break;
      case Op::neg:
        values.push_back(-at(c.a));
        break;
      default:
        ADD_FAILURE() << "not rational";
        return {};
    }
  }
  std::vector<cln::cl_RA> result;
  for (const int output : program.outputs) result.push_back(at(output));
  return result;
}

/// Dyadic rationals in about (-4, 4), the same in every run; exact in double.
class Points {
 public:
  cln::cl_RA next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    const auto value = static_cast<long>((state_ >> 40) & 0xffff) - 0x8000;
    return cln::cl_RA(value == 0 ? 1 : value) / 8192;
  }

 private:
  unsigned long long state_ = 20240229;
};

using casimir::test::Folder;

inline void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Runs a program in a new process; `messages` holds the beginning of what it printed.
inline codegen::CompilerRun run(const std::string& program,
                                const std::vector<std::string>& arguments,
                                const std::filesystem::path& folder) {
  return codegen::run_compiler(codegen::find_compiler(program), arguments, folder);
}

/// An entry point of a shared object. The object stays loaded.
template <class F>
F* entry(const std::filesystem::path& object, const char* name) {
  void* handle = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) ADD_FAILURE() << dlerror();
  return handle ? reinterpret_cast<F*>(dlsym(handle, name)) : nullptr;
}

}  // namespace casimir::testing
