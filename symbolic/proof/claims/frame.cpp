// The frame of the Poincare-Chetaev equations, Borisov & Mamaev, Sec. 1.2: the fields close, and
// where the file gives a Lagrangian, its Legendre transform and the equations (1.17) belong to the
// bracket and the Hamiltonian.
#include <fmt/format.h>

#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/claims/claim.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// An expression that ought to vanish identically.
struct Defect {
  std::string label;
  ex value;
};

/// \param divisors  what the claim divides by beside that
Claim vanishing(const std::string& name, const std::vector<Defect>& defects,
                const std::vector<ex>& divisors = {}) {
  Claim claim{
      ClaimKind::identity, name, false, [defects](Prover& prover, Proof& proof) {
        std::vector<Residual> residuals;
        for (const Defect& defect : defects) {
          const ex value = defect.value;
          residuals.push_back({defect.label, prover.convert(value), [value] { return value; }});
        }
        prover.decide(proof, residuals, {});
      }};
  for (const Defect& defect : defects) claim.expressions.push_back(defect.value);
  for (const ex& divisor : divisors) claim.expressions.push_back(1 / divisor);
  claim.subject = Subject::functions;
  return claim;
}

/// [v^i, v^j] = sum_s c_ij^s v^s
std::vector<Defect> closure(const Frame& frame) {
  std::vector<Defect> defects;
  for (std::size_t i = 0; i < frame.momenta.size(); ++i) {
    for (std::size_t j = i + 1; j < frame.momenta.size(); ++j) {
      const std::vector<ex> commutator = frame.commutator(i, j);
      for (std::size_t q = 0; q < frame.coordinates.size(); ++q) {
        ex value = commutator[q];
        for (std::size_t s = 0; s < frame.momenta.size(); ++s)
          value -= frame.c(i, j, s) * frame.fields[s][q];
        defects.push_back({fmt::format("[v{}, v{}] less its combination, along {}", i + 1, j + 1,
                                       frame.coordinates[q].get_name()),
                           value});
      }
    }
  }
  return defects;
}

/// A function of coordinates and velocities where w = dH/dM: on the phase space.
class Lagrangian {
 public:
  explicit Lagrangian(const Model& model) : model_(model), frame_(*model.frame) {
    for (std::size_t s = 0; s < frame_.momenta.size(); ++s) {
      velocities_.push_back(model.hamiltonian->diff(frame_.momenta[s]));
      values_[frame_.velocities[s]] = velocities_.back();
    }
  }

  ex on_phase_space(const ex& f) const { return substituted(f, values_, model_.limits); }
  ex momentum(std::size_t s) const {
    return on_phase_space(frame_.lagrangian->diff(frame_.velocities[s]));
  }

  /// (1.22): M_s = dL/dw_s, v^s(L) = - v^s(H), H = sum w_s M_s - L.
  std::vector<Defect> legendre() const {
    std::vector<Defect> defects;
    ex energy = -on_phase_space(*frame_.lagrangian) - *model_.hamiltonian;
    for (std::size_t s = 0; s < velocities_.size(); ++s) {
      const std::string name = frame_.momenta[s].get_name();
      defects.push_back({fmt::format("{} - dL/d{}", name, frame_.velocities[s].get_name()),
                         frame_.momenta[s] - momentum(s)});
      defects.push_back({fmt::format("v(L) + v(H) for {}", name),
                         on_phase_space(frame_.along(s, *frame_.lagrangian)) +
                             frame_.along(s, *model_.hamiltonian)});
      energy += velocities_[s] * frame_.momenta[s];
    }
    defects.push_back({"sum of w*M - L - H", energy});
    return defects;
  }

  /// (1.17): d/dt(dL/dw_i) = sum c_ri^s w_r dL/dw_s + v^i(L).
  std::vector<Defect> poincare_chetaev() const {
    std::vector<Defect> defects;
    for (std::size_t i = 0; i < velocities_.size(); ++i) {
      ex value = model_.rate(momentum(i)) - on_phase_space(frame_.along(i, *frame_.lagrangian));
      for (std::size_t r = 0; r < velocities_.size(); ++r) {
        for (std::size_t s = 0; s < velocities_.size(); ++s)
          value -= frame_.c(r, i, s) * velocities_[r] * momentum(s);
      }
      defects.push_back({fmt::format("the equation of {}", frame_.momenta[i].get_name()), value});
    }
    return defects;
  }

  /// The equations of Euler and Lagrange in the coordinates themselves, where w = A(x) dx/dt.
  std::vector<Defect> euler_lagrange() const {
    const auto n = static_cast<unsigned>(frame_.coordinates.size());
    const GiNaC::matrix a = fields().inverse();
    std::vector<Defect> defects;
    for (unsigned i = 0; i < n; ++i) {
      const GiNaC::symbol& x = frame_.coordinates[i];
      ex momentum_of_x = 0;
      ex slope = on_phase_space(frame_.lagrangian->diff(x));
      for (unsigned s = 0; s < n; ++s) {
        momentum_of_x += a(s, i) * momentum(s);
        for (unsigned k = 0; k < n; ++k)
          slope += momentum(s) * a(s, k).diff(x) * model_.rate(frame_.coordinates[k]);
      }
      defects.push_back(
          {fmt::format("the equation of {}", x.get_name()), model_.rate(momentum_of_x) - slope});
    }
    return defects;
  }

  /// The determinant of the fields: where it vanishes, the velocities are no functions of dx/dt.
  ex volume() const { return fields().determinant().normal(); }

 private:
  /// The matrix with dx/dt = fields * w.
  GiNaC::matrix fields() const {
    const auto n = static_cast<unsigned>(frame_.coordinates.size());
    GiNaC::matrix result(n, n);
    for (unsigned i = 0; i < n; ++i)
      for (unsigned s = 0; s < n; ++s) result(i, s) = fit_for_normal(frame_.fields[s][i]);
    return result;
  }

  const Model& model_;
  const Frame& frame_;
  std::vector<ex> velocities_;  ///< dH/dM_s
  GiNaC::exmap values_;
};

}  // namespace

std::vector<Claim> frame_claims(const Model& model) {
  std::vector<Claim> claims;
  if (!model.frame) return claims;
  claims.push_back(vanishing("the frame closes", closure(*model.frame)));
  if (!model.frame->lagrangian) return claims;
  const Lagrangian lagrangian(model);
  claims.push_back(vanishing("Legendre transform", lagrangian.legendre()));
  claims.push_back(vanishing("Poincare-Chetaev equations", lagrangian.poincare_chetaev()));
  if (model.frame->coordinates.size() == model.frame->momenta.size()) {
    try {
      claims.push_back(vanishing("Euler-Lagrange equations", lagrangian.euler_lagrange(),
                                 {lagrangian.volume()}));
    } catch (const std::runtime_error&) {
      // The fields are dependent (redundant coordinates): there are no such equations.
    }
  }
  return claims;
}

}  // namespace casimir
