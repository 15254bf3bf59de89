#include "symbolic/lie_algebra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>
#include <utility>

#include "symbolic/error.hpp"

namespace casimir {
namespace {

constexpr int kMaxOrthogonal = 12;
constexpr int kMaxVectors = 8;

int epsilon(int i, int j, int k) { return (i - j) * (j - k) * (k - i) / 2; }

/// Adds {a_i, b_j} = factor * eps_ijk c_k, where a, b, c are the blocks of three variables that
/// start at the given indices; each bracket once, with the smaller index first.
void add_cross(LieAlgebra& algebra, std::size_t a, std::size_t b, std::size_t c, int factor) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = a == b ? i + 1 : 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int e = epsilon(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
        if (e != 0) algebra.constants.push_back({a + i, b + j, c + k, factor * e});
      }
    }
  }
}

/// so(3) acting on `vectors` copies of R^3, whose own brackets are -kappa eps M (one copy).
LieAlgebra rotations(std::string name, int vectors, int kappa) {
  LieAlgebra algebra{std::move(name), "M1 M2 M3", 3 + 3 * static_cast<std::size_t>(vectors), {}};
  add_cross(algebra, 0, 0, 0, -1);
  for (int v = 1; v <= vectors; ++v) {
    const std::size_t start = 3 * static_cast<std::size_t>(v);
    add_cross(algebra, 0, start, start, -1);
    if (kappa != 0) add_cross(algebra, start, start, 0, -kappa);
    const char letter = vectors == 1 ? 'g' : static_cast<char>('a' + v - 1);
    algebra.order += fmt::format(" {0}1 {0}2 {0}3", letter);
  }
  return algebra;
}

/// so(n) in J_ij, and with `translations` e(n) in J_ij, p_i.
LieAlgebra orthogonal(std::string name, int n, bool translations) {
  LieAlgebra algebra{std::move(name), "", 0, {}};
  std::map<std::pair<int, int>, std::size_t> index;
  for (int i = 1; i <= n; ++i) {
    for (int j = i + 1; j <= n; ++j) {
      index[{i, j}] = algebra.dimension++;
      algebra.order += fmt::format("{}J{}{}", algebra.order.empty() ? "" : " ", i, j);
    }
  }
  const auto add = [&](std::size_t x, std::size_t y, std::size_t z, int factor) {
    if (x < y) algebra.constants.push_back({x, y, z, factor});
  };
  // {J_ab, J_cd} with exactly one common index; J_ba = -J_ab gives the signs.
  for (const auto& [ab, x] : index) {
    for (const auto& [cd, y] : index) {
      for (const auto& [a, b, s] :
           {std::tuple(ab.first, ab.second, 1), std::tuple(ab.second, ab.first, -1)}) {
        for (const auto& [c, d, t] :
             {std::tuple(cd.first, cd.second, 1), std::tuple(cd.second, cd.first, -1)}) {
          if (b != c || a == d) continue;
          add(x, y, index.at(std::minmax(a, d)), s * t * (a < d ? 1 : -1));
        }
      }
    }
  }
  if (!translations) return algebra;
  const std::size_t p = algebra.dimension;
  algebra.dimension += static_cast<std::size_t>(n);
  for (int i = 1; i <= n; ++i) algebra.order += fmt::format(" p{}", i);
  for (const auto& [ij, x] : index) {
    const std::size_t pi = p + static_cast<std::size_t>(ij.first) - 1;
    const std::size_t pj = p + static_cast<std::size_t>(ij.second) - 1;
    add(x, pj, pi, 1);
    add(x, pi, pj, -1);
  }
  return algebra;
}

/// (1.65): momenta and Rodrigues-Hamilton parameters l0, l1, l2, l3.
LieAlgebra quaternions() {
  LieAlgebra algebra{"l(7)", "M1 M2 M3 l0 l1 l2 l3", 7, {}};
  add_cross(algebra, 0, 0, 0, -1);
  for (std::size_t i = 0; i < 3; ++i) {
    algebra.constants.push_back({i, 3, 4 + i, 1, 2});
    algebra.constants.push_back({i, 4 + i, 3, -1, 2});
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int e = epsilon(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
        if (e != 0) algebra.constants.push_back({i, 4 + j, 4 + k, -e, 2});
      }
    }
  }
  return algebra;
}

std::string bare(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

/// What other books call these algebras, bare.
constexpr std::pair<std::string_view, std::string_view> kOtherNames[] = {
    {"se3", "e(3)"},   {"iso3", "e(3)"},       {"euclid3", "e(3)"},  {"sen", "e(n)"},
    {"se4", "e(4)"},   {"su2", "so(3)"},       {"so31r", "so(3,1)"}, {"so13", "so(3,1)"},
    {"sl2r", "sl(2)"}, {"heisenberg", "h(3)"}, {"heis", "h(3)"},     {"so3xr3", "so(3)+R3"},
};

/// Takes a number without a sign from the front; empty where there is none. What has more than
/// three digits is more than any algebra has.
std::optional<int> take_number(std::string_view& text) {
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  if (digits == 0) return std::nullopt;
  const std::string number(text.substr(0, digits));
  text.remove_prefix(digits);
  return digits > 3 ? 1000 : std::stoi(number);
}

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

/// k of so(3)+k*R3, which may be written so(3)+kR^3 and, of 1, left out.
std::optional<int> vectors_of(std::string_view key) {
  if (!take(key, "so(3)+")) return std::nullopt;
  const std::optional<int> count = take_number(key);
  if (count) take(key, "*");
  return key == "R3" || key == "R^3" ? count.value_or(1) : std::optional<int>{};
}

/// n of so(n) or e(n).
std::optional<int> dimension_of(std::string_view key, std::string_view family) {
  if (!take(key, family) || !take(key, "(")) return std::nullopt;
  const std::optional<int> n = take_number(key);
  return key == ")" ? n : std::nullopt;
}

}  // namespace

std::optional<LieAlgebra> find_lie_algebra(const std::string& name) {
  std::string key = name;
  std::erase(key, ' ');
  if (key == "so(3)") return rotations(key, 0, 0);
  if (key == "e(3)") return rotations(key, 1, 0);
  if (key == "so(4)") return rotations(key, 1, 1);
  if (key == "so(3,1)") return rotations(key, 1, -1);
  if (key == "l(7)") return quaternions();
  // [h,e] = 2e, [h,f] = -2f, [e,f] = h; and [x,y] = z. The bracket of the dual has the other sign.
  if (key == "sl(2)")
    return LieAlgebra{key, "h e f", 3, {{0, 1, 1, -2}, {0, 2, 2, 2}, {1, 2, 0, -1}}};
  if (key == "h(3)") return LieAlgebra{key, "x y z", 3, {{0, 1, 2, -1}}};

  if (key.size() > 40) return std::nullopt;
  if (const auto count = vectors_of(key); count && *count >= 1 && *count <= kMaxVectors)
    return rotations(key, *count, 0);
  for (const char* family : {"so", "e"})
    if (const auto n = dimension_of(key, family); n && *n >= 3 && *n <= kMaxOrthogonal)
      return orthogonal(key, *n, *family == 'e');
  return std::nullopt;
}

std::vector<std::string> lie_algebra_names() {
  return {"so(3)", "e(3)",       "so(4)", "so(3,1)", "so(n)",
          "e(n)",  "so(3)+k*R3", "l(7)",  "sl(2)",   "h(3)"};
}

std::string lie_algebra_hint(const std::string& name) {
  const std::vector<std::string> names = lie_algebra_names();
  if (bare(name) == "canonical")
    return "canonical brackets are no algebra: canonical = true takes the place of 'algebra'";
  for (const auto& [elsewhere, here] : kOtherNames) {
    if (bare(name) == elsewhere) return fmt::format("did you mean '{}'?", here);
  }
  // The same but for case and punctuation, as "E3".
  const auto same =
      std::ranges::find_if(names, [&](const auto& known) { return bare(known) == bare(name); });
  return suggest_or_list(same == names.end() ? name : *same, names);
}

}  // namespace casimir
