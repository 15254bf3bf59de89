#include "symbolic/algebra/integer_factors.hpp"

#include <cln/integer_io.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

namespace casimir {
namespace {

std::string factors_of(const std::string& number) {
  const auto factors = prime_factors(cln::cl_I(number.c_str()));
  if (!factors) return "not found";
  std::string text;
  for (const auto& [prime, exponent] : *factors) {
    std::ostringstream out;
    out << prime << '^' << exponent << ' ';
    text += out.str();
  }
  return text;
}

TEST(IntegerFactors, AreFoundWhateverTheirSize) {
  EXPECT_EQ(factors_of("1"), "");
  EXPECT_EQ(factors_of("360"), "2^3 3^2 5^1 ");
  EXPECT_EQ(factors_of("32749"), "32749^1 ");
  // Mersenne's numbers 2^67 - 1 (Cole, 1903), 2^61 - 1 and 2^89 - 1.
  EXPECT_EQ(factors_of("147573952589676412927"), "193707721^1 761838257287^1 ");
  EXPECT_EQ(factors_of("2305843009213693951"), "2305843009213693951^1 ");
  EXPECT_EQ(factors_of("618970019642690137449562111"), "618970019642690137449562111^1 ");
}

TEST(IntegerFactors, RepeatedPrimesAreListedOnce) {
  EXPECT_EQ(factors_of("19811652503659343385539330669"), "2147483647^2 4295967341^1 ");
  EXPECT_EQ(factors_of("374144419692017845721280609523536354218570182592401"),
            "1099511627791^2 17592186056761^2 ");
}

TEST(IntegerFactors, LargeProductsAreNotFound) {
  EXPECT_EQ(factors_of("2658455991569831839194255993715294703"), "not found");  // 60 and 61 bits
  EXPECT_EQ(factors_of("0"), "not found");
  EXPECT_EQ(factors_of("-4"), "not found");
}

/// FLINT's quadratic sieve would write one there, always of the same name.
TEST(IntegerFactors, NoFileIsWrittenInTheWorkingFolder) {
  const std::filesystem::path folder = std::filesystem::current_path();
  std::filesystem::current_path("/proc");  // nobody makes files here
  const std::string text = factors_of("19342813127671420631044951");
  const std::string word = factors_of("9223372021822390277");
  std::filesystem::current_path(folder);
  EXPECT_EQ(text, "1099511627791^1 17592186056761^1 ");
  EXPECT_EQ(word, "2147483647^1 4294967291^1 ");
}

}  // namespace
}  // namespace casimir
