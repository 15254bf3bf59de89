#include "symbolic/functions/sign_table.hpp"

#include <gtest/gtest.h>

#include "symbolic/functions/convert/converter.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

class SignTables : public testing::Test {
 protected:
  /// The sign that is known of y where these hold.
  int sign_of_y(const std::vector<Assumption>& assumptions) {
    functions::GeneratorTable table({x_, y_}, {});
    table.restart();
    functions::SignTable signs(table, assumptions);
    functions::Converter converter(table, signs, 0);
    signs.read(converter.converting());
    return signs.known_sign(converter.convert(y_));
  }
  static Assumption positive(const ex& e) { return {e, Comparison::greater, ""}; }
  static Assumption not_negative(const ex& e) { return {e, Comparison::at_least, ""}; }

  GiNaC::symbol x_{"x"}, y_{"y"};
};

TEST_F(SignTables, OfAProductGivesThatOfItsOnlyUnknownFactor) {
  EXPECT_EQ(sign_of_y({positive(x_ * y_), positive(x_)}), 1);
  EXPECT_EQ(sign_of_y({positive(x_ * y_), positive(-x_)}), -1);
  EXPECT_EQ(sign_of_y({positive(x_ * y_)}), 0);
}

TEST_F(SignTables, SayNothingWhereAnotherFactorMayVanish) {
  EXPECT_EQ(sign_of_y({positive(x_ * x_ * y_)}), 1);
  EXPECT_EQ(sign_of_y({not_negative(x_ * x_ * y_)}), 0);
  EXPECT_EQ(sign_of_y({not_negative(x_ * y_), not_negative(x_)}), 0);
  EXPECT_EQ(sign_of_y({not_negative(x_ * y_), positive(x_)}), 1);
}

}  // namespace
}  // namespace casimir
