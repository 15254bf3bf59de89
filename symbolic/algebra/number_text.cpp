#include "symbolic/algebra/number_text.hpp"

#include <cln/rational_io.h>

#include <sstream>

namespace casimir {

std::string rational_text(const cln::cl_RA& value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

std::string expression_text(const GiNaC::ex& value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

void append_term(std::string& sum, const cln::cl_RA& coefficient, const std::string& monomial) {
  const bool minus = cln::minusp(coefficient);
  sum += sum.empty() ? (minus ? "-" : "") : (minus ? " - " : " + ");
  const cln::cl_RA size = cln::abs(coefficient);
  if (monomial.empty())
    sum += rational_text(size);
  else
    sum += size == 1 ? monomial : rational_text(size) + "*" + monomial;
}

std::string quotient_text(const std::string& top, bool top_is_sum, const std::string& bottom) {
  return (top_is_sum ? "(" + top + ")" : top) + "/(" + bottom + ")";
}

}  // namespace casimir
