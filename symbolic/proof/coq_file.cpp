#include "symbolic/proof/coq_file.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {
namespace {

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// " PREFIX1 PREFIX2 .."
std::string numbered(const char* prefix, std::size_t count) {
  std::string result;
  for (std::size_t i = 1; i <= count; ++i) result += fmt::format(" {}{}", prefix, i);
  return result;
}

/// Of a rational number that is not negative.
std::string number(const cln::cl_RA& value) {
  const cln::cl_I denominator = cln::denominator(value);
  if (denominator == 1) return rational_text(cln::numerator(value));
  return fmt::format("({} # {})", rational_text(cln::numerator(value)), rational_text(denominator));
}

void add(std::string& sum, const std::string& term) { sum += (sum.empty() ? "" : "\n  + ") + term; }

/// Text that neither ends the comment it stands in nor begins a string or another comment.
std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        return !is_letter_or_digit(c) &&
               std::string_view("_-+=.,:;\n ").find(c) == std::string::npos;
      },
      ' ');
  return text;
}

}  // namespace

bool is_coq_name(const std::string& name) {
  return !name.empty() && name.size() <= kMaxNameLength &&
         std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return static_cast<unsigned char>(c) < 0x80 && (is_letter_or_digit(c) || c == '_');
         });
}

std::string coq_name(const std::string& name) {
  if (!is_coq_name(name)) throw std::logic_error("a name that must not reach Coq");
  std::string result;
  for (const char c : name) result += c == '_' ? std::string("__") : std::string(1, c);
  return result;
}

CoqFile::CoqFile(const std::vector<GiNaC::symbol>& symbols, std::size_t dimension)
    : dimension_(dimension) {
  for (const GiNaC::symbol& s : symbols) {
    names_.push_back(coq_name(s.get_name()));
    symbols_.push_back("x_" + names_.back());
    arguments_ += " " + symbols_.back();
  }
}

void CoqFile::begin_part(const std::string& title) {
  for (std::string* part : {&definitions_, &lemmas_, &theorems_})
    *part += fmt::format("(* {} *)\n", plain(title));
}

void CoqFile::end_with(const std::string& text) { end_ += fmt::format("(* {} *)\n", plain(text)); }

std::string CoqFile::polynomial(const Polynomial& p) const {
  std::string result;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    std::string factors;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      for (unsigned long k = 0; k < exponents[i]; ++k)
        factors += (factors.empty() ? "" : "*") + symbols_[i];
    }
    const cln::cl_RA size = cln::abs(coefficient);
    const bool minus = cln::minusp(coefficient);
    if (result.empty())
      result = minus ? "- " : "";
    else
      result += minus ? " - " : " + ";
    if (factors.empty())
      result += number(size);
    else
      result += (size == 1 ? "" : number(size) + "*") + factors;
  }
  return result.empty() ? "0" : result;
}

std::string CoqFile::call(const std::string& function) const {
  return "(" + function + arguments_ + ")";
}

void CoqFile::definition(const std::string& name, const std::string& arguments,
                         const std::string& value) {
  definitions_ +=
      fmt::format("Definition {} ({} : Q) : Q :=\n  {}.\n", name, arguments.substr(1), value);
  defined_.push_back(name);
}

const Polynomial& CoqFile::upper(std::size_t i, std::size_t j) const {
  return upper_[i * dimension_ - i * (i + 1) / 2 + (j - i - 1)];
}

std::string CoqFile::bracket_name(std::size_t i, std::size_t j) const {
  return fmt::format("bracket_{}_and_{}", names_[i], names_[j]);
}

/// {x_i, x_j}, or empty where it is zero.
std::string CoqFile::entry(std::size_t i, std::size_t j) const {
  if (i == j || upper(std::min(i, j), std::max(i, j)).is_zero()) return "";
  if (i > j) return "(- " + entry(j, i) + ")";
  return call(bracket_name(i, j));
}

/// d{x_i, x_j}/dx_l.
std::string CoqFile::entry_slope(std::size_t i, std::size_t j, std::size_t l) const {
  if (i == j || !upper(std::min(i, j), std::max(i, j)).uses(l)) return "0";
  if (i > j) return "(- " + entry_slope(j, i, l) + ")";
  return call(fmt::format("{}_d_{}", bracket_name(i, j), names_[l]));
}

void CoqFile::define_bracket(const std::vector<Polynomial>& upper_entries) {
  upper_ = upper_entries;
  for (std::size_t i = 0; i < dimension_; ++i) {
    for (std::size_t j = i + 1; j < dimension_; ++j) {
      if (upper(i, j).is_zero()) continue;
      const CoqFunction f{bracket_name(i, j), upper(i, j)};
      definition(f.name, arguments_, polynomial(f.value));
      for (std::size_t l = 0; l < dimension_; ++l) {
        if (f.value.uses(l)) define_slope(f, l);
      }
    }
  }
  const std::string f = numbered("f_", dimension_), g = numbered("g_", dimension_);
  std::string all;
  for (std::size_t i = 0; i < dimension_; ++i) {
    std::string sum;
    for (std::size_t j = 0; j < dimension_; ++j) {
      if (const std::string factor = entry(i, j); !factor.empty())
        add(sum, fmt::format("{} * g_{}", factor, j + 1));
    }
    definition("row_" + names_[i], g + arguments_, sum.empty() ? "0" : sum);
    add(all, fmt::format("f_{} * {}", i + 1, row(i, g)));
  }
  definition("poisson", f + g + arguments_, all);
  definitions_ += "\n";
}

/// {x_i, g} where g has that gradient.
std::string CoqFile::row(std::size_t i, const std::string& gradient) const {
  return fmt::format("(row_{}{}{})", names_[i], gradient, arguments_);
}

CoqFunction CoqFile::define(const std::string& name, const Polynomial& value) {
  CoqFunction f{name, value};
  definition(f.name, arguments_, polynomial(f.value));
  for (std::size_t i = 0; i < dimension_; ++i) define_slope(f, i);
  definitions_ += "\n";
  return f;
}

void CoqFile::define_slope(const CoqFunction& f, std::size_t i) {
  const std::string name = fmt::format("{}_d_{}", f.name, names_[i]);
  const Polynomial slope = f.value.derivative(i);
  definition(name, arguments_, polynomial(slope));
  // Taylor's formula: the rest after the first two terms, divided by h^2.
  std::string rest;
  std::string powers = "1";
  Polynomial term = slope;
  for (long k = 2; !term.is_zero(); ++k) {
    term = term.derivative(i).scaled(cln::cl_RA(1) / k);
    if (term.is_zero()) break;
    rest += (rest.empty() ? "" : " + ") + fmt::format("{}*({})", powers, polynomial(term));
    powers += "*h";
  }
  std::string moved;
  for (std::size_t k = 0; k < symbols_.size(); ++k)
    moved += k == i ? fmt::format(" ({} + h)", symbols_[k]) : " " + symbols_[k];
  lemmas_ += fmt::format(
      "Lemma {0}_is_derivative : forall{1} h : Q,\n  {2}{3} - {2}{1} == h * {0}{1} + h * h * "
      "({4}).\nProof. casimir_identity. Qed.\n",
      name, arguments_, f.name, moved, rest.empty() ? "0" : rest);
}

std::string CoqFile::gradient(const CoqFunction& f) const {
  std::string result = "\n   ";
  for (std::size_t i = 0; i < dimension_; ++i)
    result += " " + call(fmt::format("{}_d_{}", f.name, names_[i]));
  return result + "\n   ";
}

std::string CoqFile::unit(std::size_t i) const {
  std::string result;
  for (std::size_t k = 0; k < dimension_; ++k) result += k == i ? " 1" : " 0";
  return result;
}

std::string CoqFile::combination(const std::vector<CoqFunction>& level,
                                 const std::vector<Polynomial>& cofactors) const {
  std::string sum;
  for (std::size_t k = 0; k < level.size(); ++k)
    add(sum, fmt::format("({}) * {}", polynomial(cofactors[k]), call(level[k].name)));
  return sum.empty() ? "0" : sum;
}

void CoqFile::theorem(const std::string& name, const std::string& variables,
                      const std::string& left, const std::string& right) {
  theorems_ +=
      fmt::format("Theorem {} : forall{} : Q,\n  {}\n  == {}.\nProof. casimir_identity. Qed.\n\n",
                  name, variables, left, right);
}

void CoqFile::state_skew_symmetry() {
  const std::string f = numbered("f_", dimension_), g = numbered("g_", dimension_);
  theorem("skew_symmetry", f + g + arguments_, "poisson" + f + g + arguments_,
          "- (poisson" + g + f + arguments_ + ")");
}

void CoqFile::state_jacobi() {
  const auto slopes = [&](std::size_t i, std::size_t j) {
    std::string result;
    for (std::size_t l = 0; l < dimension_; ++l) result += " " + entry_slope(i, j, l);
    return result;
  };
  for (std::size_t i = 0; i < dimension_; ++i) {
    for (std::size_t j = i + 1; j < dimension_; ++j) {
      for (std::size_t k = j + 1; k < dimension_; ++k) {
        std::string sum = row(i, slopes(j, k));
        add(sum, row(j, slopes(k, i)));
        add(sum, row(k, slopes(i, j)));
        theorem(fmt::format("jacobi_{}_and_{}_and_{}", names_[i], names_[j], names_[k]), arguments_,
                sum, "0");
      }
    }
  }
}

void CoqFile::state_commutes_with_all(const std::string& name, const CoqFunction& f) {
  const std::string g = numbered("g_", dimension_);
  theorem(name, g + arguments_, "poisson" + gradient(f) + g + arguments_, "0");
}

void CoqFile::state_bracket(const std::string& name, const CoqFunction& f, const CoqFunction& g,
                            const std::vector<CoqFunction>& level,
                            const std::vector<Polynomial>& cofactors) {
  theorem(name, arguments_, "poisson" + gradient(f) + gradient(g) + arguments_,
          combination(level, cofactors));
}

void CoqFile::state_bracket(const std::string& name, std::size_t i, const CoqFunction& f,
                            const std::vector<CoqFunction>& level,
                            const std::vector<Polynomial>& cofactors) {
  theorem(fmt::format("{}_{}", name, names_[i]), arguments_,
          "poisson" + unit(i) + gradient(f) + arguments_, combination(level, cofactors));
}

std::string CoqFile::text(const std::string& head) const {
  return fmt::format(
      "(* {} *)\nFrom Coq Require Import QArith Ring.\nOpen Scope Q_scope.\n\n"
      "(** Definitions *)\n\n{}\n"
      "Ltac casimir_identity :=\n  intros; cbv beta delta [{}]; ring.\n\n"
      "(** Derivatives *)\n\n{}\n(** Theorems *)\n\n{}{}",
      plain(head), definitions_, fmt::join(defined_, " "), lemmas_, theorems_, end_);
}

}  // namespace casimir
