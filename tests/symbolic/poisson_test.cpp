#include "symbolic/poisson.hpp"

#include <gtest/gtest.h>

#include "symbolic/error.hpp"

namespace casimir {
namespace {

class So3 : public testing::Test {
 protected:
  GiNaC::symbol m1_{"M1"}, m2_{"M2"}, m3_{"M3"};
  PoissonStructure so3_{{m1_, m2_, m3_}, {-m3_, m2_, -m1_}};
};

TEST_F(So3, IsSkew) {
  EXPECT_EQ(so3_(0, 1), -m3_);
  EXPECT_EQ(so3_(1, 0), m3_);
  EXPECT_EQ(so3_(2, 2), 0);
}

TEST_F(So3, FlowIsEulersEquations) {
  const GiNaC::ex h = (m1_ * m1_ + 2 * m2_ * m2_ + 3 * m3_ * m3_) / 2;
  const std::vector<GiNaC::ex> flow = so3_.flow(h);
  // dM/dt = M x dH/dM
  EXPECT_EQ(flow[0].expand(), (3 - 2) * m2_ * m3_);
  EXPECT_EQ(flow[1].expand(), (1 - 3) * m3_ * m1_);
  EXPECT_EQ(flow[2].expand(), (2 - 1) * m1_ * m2_);
}

// A check that cannot fail proves nothing: bend one bracket and see the exact defect.
TEST_F(So3, BentBracketBreaksJacobiByTheExpectedAmount) {
  const PoissonStructure bent{{m1_, m2_, m3_}, {m1_ * m1_ - m3_, m2_, -m1_}};
  EXPECT_EQ(so3_.jacobi_defect(0, 1, 2).expand(), 0);
  EXPECT_EQ(bent.jacobi_defect(0, 1, 2).expand(), (-2 * m1_ * m2_).expand());
}

TEST_F(So3, WrongCountsAndRepeatedCoordinatesAreRefused) {
  EXPECT_THROW(PoissonStructure({m1_, m2_, m3_}, {m3_}), ModelError);
  EXPECT_THROW(PoissonStructure({m1_, m1_}, {m3_}), ModelError);
}

}  // namespace
}  // namespace casimir
