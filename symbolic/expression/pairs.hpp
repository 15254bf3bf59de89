#pragma once

#include <ginac/ginac.h>

namespace casimir {

/// The pairs of which GiNaC makes a sum (rest * coeff) or a product (rest ^ coeff). Its public op()
/// builds a new expression for each of them, which would take most of the time of a proof.
class Pairs : public GiNaC::expairseq {
 public:
  /// \param e  a sum or a product
  static const GiNaC::epvector& of(const GiNaC::ex& e) {
    return GiNaC::ex_to<GiNaC::expairseq>(e).*(&Pairs::seq);
  }
  /// The number that is added to, or multiplied by, all of them.
  static const GiNaC::ex& number(const GiNaC::ex& e) {
    return GiNaC::ex_to<GiNaC::expairseq>(e).*(&Pairs::overall_coeff);
  }
};

}  // namespace casimir
