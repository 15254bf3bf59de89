#pragma once

#include <string>

#include "symbolic/search/search.hpp"

namespace casimir::test {

inline Text text(const std::string& value) { return {value, {"test", 1, 1}, value}; }

inline search::Request up_to(int degree) {
  search::Request request;
  request.degree = degree;
  return request;
}

/// A heavy body in the axes and the order of the book.
inline std::string euler_poisson(const std::string& hamiltonian,
                                 const std::string& parameters = {}) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
         "algebra = \"e(3)\"\n[parameters]\n" +
         parameters;
}

}  // namespace casimir::test
