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
     "NULL", "I", "EOF", "NAN", "INFINITY", "HUGE", "PATH_MAX", "NAME_MAX", "LINE_MAX", "SSIZE_MAX",
     "TMP_MAX", "FOPEN_MAX", "FILENAME_MAX", "MB_LEN_MAX", "MB_CUR_MAX", "PIPE_BUF", "NZERO",
     "TIME_UTC", "BIG_ENDIAN", "LITTLE_ENDIAN", "BYTE_ORDER", "SEEK_SET", "SEEK_CUR", "SEEK_END",
     "SIG_IGN", "SIG_DFL", "SIG_ERR", "SIGKILL", "SIGUSR1", "SIGUSR2", "ELOOP", "EDQUOT", "SNAN",
     "SNANF", "SNANL", "HUGE_VAL", "HUGE_VALF", "HUGE_VALL", "errno", "BUFSIZ", "MAXFLOAT",
     "math_errhandling", "E2BIG", "EACCES", "EAGAIN", "EBADF", "EBUSY", "ECHILD", "EDEADLK", "EDOM",
     "EEXIST", "EFAULT", "EFBIG", "EILSEQ", "EINTR", "EINVAL", "EIO", "EISDIR", "EMFILE", "EMLINK",
     "ENFILE", "ENODEV", "ENOENT", "ENOEXEC", "ENOLCK", "ENOMEM", "ENOSPC", "ENOSYS", "ENOTDIR",
     "ENOTTY", "ENXIO", "EPERM", "EPIPE", "EPROTO", "ERANGE", "EROFS", "ESPIPE", "ESRCH", "ESTALE",
     "ETIME", "EXDEV", "SIGABRT", "SIGFPE", "SIGILL", "SIGINT", "SIGSEGV", "SIGTERM", "assert",
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

/// Functions that common headers of C and POSIX declare in the global namespace, where no other may
/// have their name: those whose names are words.
constexpr auto kGlobalFunctions = std::to_array<std::string_view>(
    {"abort",    "abs",       "accept",    "access",    "acct",     "alarm",       "atexit",
     "atof",     "atoi",      "atol",      "atoll",     "basename", "bcmp",        "bcopy",
     "bind",     "brk",       "bsearch",   "bzero",     "calloc",   "cbrt",        "ceil",
     "chdir",    "chmod",     "chown",     "chroot",    "clearerr", "clock",       "clone",
     "close",    "connect",   "conj",      "creat",     "crypt",    "ctime",       "daemon",
     "daylight", "difftime",  "div",       "drand48",   "drem",     "dup",         "erf",
     "erfc",     "exit",      "exp10",     "exp2",      "expm1",    "fclose",      "fdim",
     "feof",     "ferror",    "fflush",    "ffs",       "fileno",   "finite",      "floor",
     "fma",      "fmax",      "fmin",      "fmod",      "fopen",    "fork",        "free",
     "frexp",    "fstat",     "fsync",     "getc",      "getenv",   "gets",        "hypot",
     "ilogb",    "index",     "ioctl",     "isatty",    "kill",     "labs",        "ldexp",
     "ldiv",     "lgamma",    "link",      "listen",    "llabs",    "lldiv",       "lockf",
     "log10",    "log1p",     "log2",      "logb",      "lrint",    "lround",      "lseek",
     "lstat",    "malloc",    "memchr",    "memcmp",    "memcpy",   "memmem",      "memset",
     "mkdir",    "mkfifo",    "mblen",     "mknod",     "mktime",   "modf",        "mount",
     "nan",      "nearbyint", "nextafter", "nice",      "open",     "pause",       "perror",
     "pipe",     "poll",      "pow10",     "printf",    "putc",     "putenv",      "puts",
     "qsort",    "raise",     "rand",      "random",    "read",     "readlink",    "realloc",
     "recv",     "remainder", "remove",    "rename",    "rewind",   "rindex",      "rint",
     "rmdir",    "round",     "sbrk",      "scalb",     "scalbn",   "scanf",       "select",
     "send",     "setenv",    "shutdown",  "sigaction", "signal",   "significand", "sleep",
     "socket",   "srand",     "srandom",   "stat",      "strcat",   "strchr",      "strcmp",
     "strcpy",   "strdup",    "strlen",    "strtod",    "swab",     "symlink",     "sync",
     "syscall",  "system",    "tgamma",    "time",      "times",    "timezone",    "tmpfile",
     "tmpnam",   "tolower",   "toupper",   "trunc",     "truncate", "ttyname",     "tzset",
     "uint",     "ulong",     "umask",     "uname",     "ungetc",   "unlink",      "usleep",
     "vfork",    "wait",      "write"});

/// M_PI and the like with the letters that <math.h> puts behind them for other types: M_PIl,
/// M_PIf64.
bool is_constant_of_math(const std::string& name) {
  constexpr auto kTypes = std::to_array<std::string_view>(
      {"l", "f", "f16", "f32", "f64", "f128", "f32x", "f64x", "f128x"});
  return name.starts_with("M_") && std::ranges::any_of(kTypes, [&](auto type) {
           return name.ends_with(type) &&
                  std::ranges::count(
                      kReserved, std::string_view(name).substr(0, name.size() - type.size())) != 0;
         });
}

/// Macros of common headers, of which there are more than a thousand, have capitals only and mostly
/// begin with one of these: DBL_MAX, FP_ILOGB0.
bool looks_like_macro(const std::string& name) {
  if (is_constant_of_math(name)) return true;
  constexpr auto kBeginnings = std::to_array<std::string_view>(
      {"CHAR_",  "CLOCKS_PER_", "DBL_",     "EXIT_",   "FLT_",    "FP_",      "INT_",     "INT8_",
       "INT16_", "INT32_",      "INT64_",   "INTMAX_", "INTPTR_", "LDBL_",    "LLONG_",   "LONG_M",
       "MATH_",  "HUGE_VAL_",   "PTRDIFF_", "RAND_",   "SCHAR_",  "SHRT_",    "SIZE_",    "UCHAR_",
       "UINT_",  "UINT8_",      "UINT16_",  "UINT32_", "UINT64_", "UINTMAX_", "UINTPTR_", "ULLONG_",
       "ULONG_", "USHRT_",      "WCHAR_M",  "WINT_M"});
  const bool loud = std::ranges::all_of(
      name, [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; });
  return loud && name.find('_') != std::string::npos &&
         std::ranges::any_of(kBeginnings, [&](auto part) { return name.starts_with(part); });
}

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

std::vector<std::string> global_functions() {
  return {kGlobalFunctions.begin(), kGlobalFunctions.end()};
}

Names::Names(std::vector<std::string> taken) : taken_(taken.begin(), taken.end()) {
  taken_.insert(kCppKeywords.begin(), kCppKeywords.end());
  taken_.insert(kMoreKeywords.begin(), kMoreKeywords.end());
  taken_.insert(kReserved.begin(), kReserved.end());
  for (const FunctionRow& function : function_table()) taken_.emplace(function.c_name);
}

std::string Names::unique(const std::string& wanted) {
  const std::string base = identifier(wanted);
  if (!is_numbered(base) && !looks_like_macro(base) && taken_.insert(base).second) return base;
  const std::string stem = base.ends_with('_') ? base : base + "_";
  if (taken_.insert(stem).second) return stem;
  for (int i = 2;; ++i) {
    if (taken_.insert(stem + std::to_string(i)).second) return stem + std::to_string(i);
  }
}

void check_header_name(const std::string& name, bool of_namespace) {
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
  if (of_namespace && std::ranges::count(kGlobalFunctions, name) != 0)
    refuse("common headers declare a function of that name");
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
