#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace casimir::tools::typeset {

/// What a node of a formula is. `text` and `parts` below say what each kind uses of them.
enum class Kind {
  letter,    ///< `text`: "M", "gamma", or indices side by side, "ijk"
  symbol,    ///< `text`, no name of a case: "pi", "partial", "varepsilon"
  word,      ///< `text`, upright: "max"
  number,    ///< `text`: digits
  prose,     ///< `text`: words of a language, with their spaces
  product,   ///< `parts` beside each other
  sum,       ///< `parts`; those of `negative` are subtracted
  list,      ///< `parts` with commas between
  fraction,  ///< parts[0] above parts[1]
  root,      ///< the square root of parts[0]
  scripts,   ///< parts[0] with parts[1] below and parts[2] above; an empty product is none
  call,      ///< the function that is printed `text`, of parts[1..]; its power, if any, is parts[0]
  brackets,  ///< parts[0] in round brackets that grow
  tuple,     ///< parts[0] in round brackets of the line's height: a scalar product
  poisson,   ///< parts[0] in braces: a Poisson bracket
  bold,      ///< parts[0], a vector
  dotted,    ///< the rate of parts[0]
  primed,    ///< the next value of parts[0]
  cross      ///< the vector product of parts[0] and parts[1]
};

/// A formula as it stands on paper: a tree that `latex` and `mathml` write.
struct Math {
  Kind kind = Kind::product;
  std::string text = {};
  std::vector<Math> parts = {};
  std::vector<bool> negative = {};  ///< of a sum, one for each part

  bool empty() const { return kind == Kind::product && parts.empty(); }
};

/// A matrix of formulas, row by row.
using MathMatrix = std::vector<std::vector<Math>>;

Math letter(std::string_view name);
Math symbol(std::string_view name);
Math number(std::string_view digits);
Math prose(std::string_view words);
/// The factors side by side; one alone is itself.
Math product(std::vector<Math> factors);
Math list(std::vector<Math> parts);
Math fraction(Math above, Math below);
Math in_brackets(Math inside);
Math with_index(Math base, Math index);
Math with_power(Math base, Math power);
Math negated(Math term);
/// One more term at the end of a sum; what is negated is subtracted.
void add_term(Math& sum, Math term);

/// The dot stands on the letter, its index beside it; that of a vector over the whole.
Math rate(const Math& letter);

/// A name of a case file: "M1" is M with the index 1, "p_theta" is p with a Greek index.
Math name(std::string_view name);

/// How wide a formula is on paper: roughly, in letters.
double width(const Math& formula);

/// A long sum in lines of at most so many letters, where terms allow it: the parts of it, of which
/// all but the first begin with a sign. Any other formula is one line.
std::vector<Math> lines_of(const Math& formula, double letters);

/// Whether `text` is the name of a Greek letter, "gamma".
bool is_greek(std::string_view text);

}  // namespace casimir::tools::typeset
