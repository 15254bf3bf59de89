// What is printed of a residual that is not zero.
#include <fmt/format.h>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir {

std::string shortened(std::string text, std::size_t terms) {
  constexpr std::size_t kLongest = 2000;
  if (text.size() <= kLongest) return text;
  const std::size_t cut = text.rfind(' ', kLongest);
  return text.substr(0, cut) + fmt::format(" ... ({} terms)", terms);
}

std::string Prover::residual_text(const Residual& residual, const Polynomial& rest,
                                  const Level& level) const {
  constexpr std::size_t kMostTerms = 300;
  if (level.empty() && rest.terms() <= kMostTerms) {
    try {
      const auto [top, bottom] = ring_.lowest_terms(residual.value);
      if (!bottom.is_constant()) {
        const std::string below = shortened(ring_.text(bottom), bottom.terms());
        return quotient_text(shortened(ring_.text(top), top.terms()), top.terms() > 1, below);
      }
    } catch (const TooLarge&) {  // the numerator alone, as on a level
    }
  }
  return shortened(ring_.text(rest), rest.terms());
}

}  // namespace casimir
