#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace casimir::codegen::wasm {

/// The opcodes that are used (WebAssembly Core Specification 1.0, Section 5.4).
enum class Code : unsigned char {
  loop = 0x03,
  if_ = 0x04,
  end = 0x0B,
  branch_if = 0x0D,
  call = 0x10,
  local_get = 0x20,
  local_set = 0x21,
  local_tee = 0x22,
  f64_load = 0x2B,
  f64_store = 0x39,
  i32_const = 0x41,
  f64_const = 0x44,
  i32_less = 0x48,
  i32_at_most = 0x4C,
  f64_equal = 0x61,
  f64_less = 0x63,
  f64_greater = 0x64,
  i32_add = 0x6A,
  i32_sub = 0x6B,
  i32_mul = 0x6C,
  f64_abs = 0x99,
  f64_neg = 0x9A,
  f64_sqrt = 0x9F,
  f64_add = 0xA0,
  f64_sub = 0xA1,
  f64_mul = 0xA2,
  f64_div = 0xA3,
  f64_from_i32 = 0xB7
};

/// The size of a double in memory.
inline constexpr int kDouble = 8;

/// The types of locals, parameters and results.
enum class Type : unsigned char { i32 = 0x7F, f64 = 0x7C };

/// Unsigned LEB128.
void append_unsigned(std::string& bytes, std::uint32_t value);
/// Signed LEB128.
void append_signed(std::string& bytes, std::int32_t value);

/// The body of a function, instruction by instruction.
class Body {
 public:
  Body& add(Code code);
  Body& get(int local);
  Body& set(int local);
  Body& tee(int local);
  Body& number(double value);
  Body& integer(int value);
  /// The double at `offset` from the address on the stack.
  Body& load(int offset);
  /// The same at `offset` from 0.
  Body& load_at(int offset);
  /// Stores the double on the stack at `offset` from the address below it.
  Body& store(int offset);
  Body& call(int function);
  /// A loop or a condition, without a result, up to `end`.
  Body& open(Code code);
  /// Back to the beginning of the innermost loop, if the stack says so.
  Body& again();

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// What a function takes and gives.
struct Signature {
  std::vector<Type> parameters = {}, results = {};
  friend bool operator==(const Signature&, const Signature&) = default;
};

/// A module with one memory, which is exported as "memory".
class ModuleWriter {
 public:
  /// A function of the module "m"; its number. All imports come before all functions.
  int import(std::string_view name, const Signature& signature);
  /// The number of the next function.
  int next() const { return static_cast<int>(imports_.size() + functions_.size()); }
  /// A function; its number.
  /// \param locals  how many of each type there are beside the parameters
  int function(const Signature& signature, const std::vector<std::pair<int, Type>>& locals,
               const Body& body);
  void exported(std::string_view name, int function);
  /// \param memory  in bytes
  std::string bytes(std::size_t memory) const;

 private:
  int type_of(const Signature& signature);

  std::vector<Signature> types_;
  struct Import {
    std::string name;
    int type;
  };
  std::vector<Import> imports_;
  struct Function {
    int type;
    std::string code;
  };
  std::vector<Function> functions_;
  std::vector<std::pair<std::string, int>> exports_;
};

}  // namespace casimir::codegen::wasm
