#include "codegen/emit/identifiers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "runtime/program/function_table.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/cpp_keywords.hpp"

namespace casimir::codegen {

namespace {

constexpr std::size_t kMaxNameLength = 100;

/// Of C++, and of C where it has more.
// Of C alone.
constexpr auto kMoreKeywords = std::to_array<std::string_view>({"typeof", "restrict"});

constexpr auto kReserved = std::to_array<std::string_view>(
    {// macros of common headers and compilers
     "NULL", "I", "EOF", "NAN", "INFINITY", "HUGE_VAL", "HUGE_VALF", "HUGE_VALL", "errno", "assert",
     "complex", "imaginary", "M_E", "M_LOG2E", "M_LOG10E", "M_LN2", "M_LN10", "M_PI", "M_PI_2",
     "M_PI_4", "M_1_PI", "M_2_PI", "M_2_SQRTPI", "M_SQRT2", "M_SQRT1_2", "FP_NAN", "FP_INFINITE",
     "FP_ZERO", "FP_NORMAL", "FP_SUBNORMAL", "DOMAIN", "SING", "OVERFLOW", "UNDERFLOW", "PLOSS",
     "TLOSS", "major", "minor", "makedev", "unix", "linux", "i386", "stdin", "stdout", "stderr",
     "min", "max", "near", "far", "small", "signals", "slots", "emit", "foreach", "B0", "TRUE",
     "FALSE", "SUNTRUE", "SUNFALSE", "RCONST", "SUN_RCONST",
     // names of this code and of what it calls
     "x", "dx", "dxdt", "t", "p", "n", "J", "y", "ydot", "fy", "dfdt", "state", "values", "real",
     "Real", "State", "Derivative", "Matrix", "Vector", "System", "system", "parameters", "rhs",
     "invariants", "jacobian", "dimension", "duration", "std", "main", "i", "j", "user", "sin",
     "cos", "tan", "exp", "log", "asin", "acos", "atan2", "sqrt", "pow", "fabs", "copysign", "j0",
     "j1", "jn", "y0", "y1", "yn", "gamma", "signgam", "tmp1", "tmp2", "tmp3", "buffer", "delta_x",
     "ddelta_x", "variational", "taylor", "start", "coefficients", "degree", "Order", "time_series",
     "gradients", "dvalues", "entries", "jacobian_entries", "jacobian_nonzeros", "jacobian_rows",
     "jacobian_columns", "prepare", "prepared", "prepared_system"});

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Letters, digits and single underscores, beginning with a letter.
std::string identifier(const std::string& wanted) {
  std::string result;
  for (const char c : wanted) {
    const char plain = is_plain(c) ? c : '_';
    if (plain == '_' && (result.empty() || result.back() == '_')) continue;
    result += plain;
  }
  if (result.empty() || (result[0] >= '0' && result[0] <= '9')) result = "v" + result;
  return result;
}

/// Names such as t1 and c12, which the emitter gives to shared terms and constants.
bool is_numbered(const std::string& name) {
  if (name.size() < 2 || (name[0] != 't' && name[0] != 'c')) return false;
  return name.find_first_not_of("0123456789", 1) == std::string::npos;
}

}  // namespace

Names::Names(std::vector<std::string> taken) : taken_(taken.begin(), taken.end()) {
  taken_.insert(kCppKeywords.begin(), kCppKeywords.end());
  taken_.insert(kMoreKeywords.begin(), kMoreKeywords.end());
  taken_.insert(kReserved.begin(), kReserved.end());
  for (const FunctionRow& function : function_table()) taken_.emplace(function.c_name);
}

std::string Names::unique(const std::string& wanted) {
  const std::string base = identifier(wanted);
  if (!is_numbered(base) && taken_.insert(base).second) return base;
  const std::string stem = base.ends_with('_') ? base : base + "_";
  if (taken_.insert(stem).second) return stem;
  for (int i = 2;; ++i) {
    if (taken_.insert(stem + std::to_string(i)).second) return stem + std::to_string(i);
  }
}

void check_header_name(const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    throw ModelError(fmt::format("'{}' cannot name generated code: {}", printable(name), why));
  };
  if (name.empty() || !std::ranges::all_of(name, is_plain) || (name[0] >= '0' && name[0] <= '9'))
    refuse("an ASCII letter, then letters, digits and '_' were expected");
  if (name[0] == '_' || name.find("__") != std::string::npos)
    refuse("names with '_' at the start or with two in a row are reserved in C++");
  if (name.ends_with('_')) refuse("what is made of it has another '_' behind it");
  if (name.size() > kMaxNameLength)
    refuse(fmt::format("it is longer than {} characters", kMaxNameLength));
  if (std::ranges::count(kCppKeywords, name) + std::ranges::count(kMoreKeywords, name) != 0)
    refuse("it is a keyword");
  const auto named_so = [&](const FunctionRow& function) { return function.c_name == name; };
  if (std::ranges::count(kReserved, name) != 0 || std::ranges::any_of(function_table(), named_so))
    refuse("it is a macro of common headers, or a name that the code itself uses");
}

std::string comment_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool printable_ascii = c >= ' ' && c <= '~';
    const char shown = c == '\n' || c == '\t' || c == '\r' ? ' ' : printable_ascii ? c : '.';
    const char safe = shown == '\\' ? '|' : shown;
    const char last = result.empty() ? ' ' : result.back();
    const bool joins = (last == '*' && safe == '/') ||
                       (last == '/' && (safe == '*' || safe == '/')) ||
                       (last == '?' && safe == '?');
    if (joins) result += ' ';
    result += safe;
  }
  while (result.ends_with(' ')) result.pop_back();
  return result;
}

std::string string_literal(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= ' ' && code <= '~' && c != '"' && c != '\\' && c != '?') {
      result += c;
      continue;
    }
    result += '\\';  // three octal digits end by themselves
    for (const int shift : {6, 3, 0}) result += static_cast<char>('0' + ((code >> shift) & 7));
  }
  return result + "\"";
}

}  // namespace casimir::codegen
