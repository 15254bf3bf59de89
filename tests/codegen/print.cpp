#include <exception>
#include <iostream>

#include "codegen/emit_cpp.hpp"
#include "symbolic/case_file.hpp"

// Prints the header and the module of the first scene of a case file.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const casimir::Model model = casimir::build_model(casimir::read_case(argv[1]));
    const casimir::Specialisation s = casimir::specialise(model, model.scenes.at(0));
    std::cout << casimir::emit_header(s) << casimir::emit_module(s);
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
  return 0;
}
