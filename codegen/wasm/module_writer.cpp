#include "codegen/wasm/module_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

namespace casimir::codegen::wasm {
namespace {

constexpr unsigned kLow = 0x7F, kMore = 0x80;
constexpr unsigned char kNothing = 0x40;  // the result of a block
constexpr unsigned char kDoublesAlign = 3;

void append(std::string& bytes, unsigned char byte) { bytes += static_cast<char>(byte); }

void append_text(std::string& bytes, std::string_view text) {
  append_unsigned(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

void append_types(std::string& bytes, const std::vector<Type>& types) {
  append_unsigned(bytes, static_cast<std::uint32_t>(types.size()));
  for (const Type type : types) append(bytes, static_cast<unsigned char>(type));
}

/// A section of a module (Section 5.5): its number, its size and what is in it.
void append_section(std::string& module, unsigned char number, std::size_t count,
                    const std::string& entries) {
  std::string content;
  append_unsigned(content, static_cast<std::uint32_t>(count));
  content += entries;
  append(module, number);
  append_text(module, content);
}

}  // namespace

void append_unsigned(std::string& bytes, std::uint32_t value) {
  for (; value > kLow; value >>= 7U) append(bytes, static_cast<unsigned char>(value | kMore));
  append(bytes, static_cast<unsigned char>(value));
}

void append_signed(std::string& bytes, std::int32_t value) {
  constexpr std::int32_t kSmallest = -64, kLargest = 63;
  for (; value < kSmallest || value > kLargest; value >>= 7)
    append(bytes, static_cast<unsigned char>(static_cast<std::uint32_t>(value) | kMore));
  append(bytes, static_cast<unsigned char>(static_cast<std::uint32_t>(value) & kLow));
}

Body& Body::add(Code code) {
  append(bytes_, static_cast<unsigned char>(code));
  return *this;
}

Body& Body::get(int local) {
  add(Code::local_get);
  append_unsigned(bytes_, static_cast<std::uint32_t>(local));
  return *this;
}

Body& Body::set(int local) {
  add(Code::local_set);
  append_unsigned(bytes_, static_cast<std::uint32_t>(local));
  return *this;
}

Body& Body::tee(int local) {
  add(Code::local_tee);
  append_unsigned(bytes_, static_cast<std::uint32_t>(local));
  return *this;
}

Body& Body::number(double value) {
  add(Code::f64_const);
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8)
    append(bytes_, static_cast<unsigned char>(bits >> shift & 0xFFU));
  return *this;
}

Body& Body::integer(int value) {
  add(Code::i32_const);
  append_signed(bytes_, value);
  return *this;
}

Body& Body::load(int offset) {
  add(Code::f64_load);
  append(bytes_, kDoublesAlign);
  append_unsigned(bytes_, static_cast<std::uint32_t>(offset));
  return *this;
}

Body& Body::load_at(int offset) { return integer(0).load(offset); }

Body& Body::store(int offset) {
  add(Code::f64_store);
  append(bytes_, kDoublesAlign);
  append_unsigned(bytes_, static_cast<std::uint32_t>(offset));
  return *this;
}

Body& Body::call(int function) {
  add(Code::call);
  append_unsigned(bytes_, static_cast<std::uint32_t>(function));
  return *this;
}

Body& Body::open(Code code) {
  add(code);
  append(bytes_, kNothing);
  return *this;
}

Body& Body::again() {
  add(Code::branch_if);
  append_unsigned(bytes_, 0);
  return *this;
}

int ModuleWriter::type_of(const Signature& signature) {
  const auto found = std::ranges::find(types_, signature);
  const auto at = found - types_.begin();
  if (found == types_.end()) types_.push_back(signature);
  return static_cast<int>(at);
}

int ModuleWriter::import(std::string_view name, const Signature& signature) {
  imports_.push_back({std::string(name), type_of(signature)});
  return static_cast<int>(imports_.size()) - 1;
}

int ModuleWriter::function(const Signature& signature,
                           const std::vector<std::pair<int, Type>>& locals, const Body& body) {
  std::string code;
  append_unsigned(code, static_cast<std::uint32_t>(locals.size()));
  for (const auto& [count, type] : locals) {
    append_unsigned(code, static_cast<std::uint32_t>(count));
    append(code, static_cast<unsigned char>(type));
  }
  code += body.bytes();
  append(code, static_cast<unsigned char>(Code::end));
  const int number = next();
  functions_.push_back({type_of(signature), std::move(code)});
  return number;
}

void ModuleWriter::exported(std::string_view name, int function) {
  exports_.emplace_back(name, function);
}

std::string ModuleWriter::bytes(std::size_t memory) const {
  constexpr unsigned char kFunction = 0x60, kOfFunction = 0x00, kOfMemory = 0x02;
  constexpr std::size_t kPage = 65536;
  std::string module("\0asm\1\0\0\0", 8);
  std::string types, imports, functions, exports, bodies;
  for (const Signature& type : types_) {
    append(types, kFunction);
    append_types(types, type.parameters);
    append_types(types, type.results);
  }
  for (const Import& import : imports_) {
    append_text(imports, "m");
    append_text(imports, import.name);
    append(imports, kOfFunction);
    append_unsigned(imports, static_cast<std::uint32_t>(import.type));
  }
  for (const Function& function : functions_) {
    append_unsigned(functions, static_cast<std::uint32_t>(function.type));
    append_text(bodies, function.code);
  }
  std::string pages("\0", 1);  // no upper limit
  append_unsigned(pages, static_cast<std::uint32_t>((memory + kPage - 1) / kPage));
  append_text(exports, "memory");
  append(exports, kOfMemory);
  append_unsigned(exports, 0);
  for (const auto& [name, number] : exports_) {
    append_text(exports, name);
    append(exports, kOfFunction);
    append_unsigned(exports, static_cast<std::uint32_t>(number));
  }
  append_section(module, 1, types_.size(), types);
  if (!imports_.empty()) append_section(module, 2, imports_.size(), imports);
  append_section(module, 3, functions_.size(), functions);
  append_section(module, 5, 1, pages);
  append_section(module, 7, exports_.size() + 1, exports);
  append_section(module, 10, functions_.size(), bodies);
  return module;
}

}  // namespace casimir::codegen::wasm
