// Any bytes as a case file: it becomes a model or is refused.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "symbolic/model.hpp"
#include "tests/fuzz/target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace casimir;
  const test::OneSecond limit;
  try {
    build_model(
        parse_case({reinterpret_cast<const char*>(data), size}, "fuzz.toml", test::small_limits()),
        {}, [](const std::string&) { return std::nullopt; });
  } catch (const CaseError&) {
  } catch (const ModelError&) {
  } catch (const SingularPoint&) {
  } catch (const std::domain_error&) {
    // Exact arithmetic where an expression has no value; the program says so as well.
  }
  return 0;
}
