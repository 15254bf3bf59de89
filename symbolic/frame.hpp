#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

#include "symbolic/case_file.hpp"
#include "symbolic/poisson.hpp"

namespace casimir {

class Scope;

/// The frame of the Poincare-Chetaev equations: vector fields v^s on the configuration space that
/// the quasi-velocities w_s belong to, dq_i/dt = sum_s v^s_i w_s, with
/// [v^i, v^j] = sum_s c_ij^s v^s (Borisov & Mamaev, Sec. 1.2).
struct Frame {
  std::vector<GiNaC::symbol> coordinates;      ///< n of them
  std::vector<GiNaC::symbol> momenta;          ///< k of them, M_s conjugate to w_s
  std::vector<GiNaC::symbol> velocities;       ///< k of them
  std::vector<std::vector<GiNaC::ex>> fields;  ///< fields[s][i] is the component v^s_i
  std::vector<GiNaC::ex> structure;            ///< k*k*k entries: c_ij^s at (i*k + j)*k + s
  std::vector<GiNaC::ex> domain;               ///< of the fields, as of NamedExpression
  std::optional<GiNaC::ex> lagrangian;         ///< L(q, w), where the file gives one

  /// The structure function c_ij^s.
  GiNaC::ex c(std::size_t i, std::size_t j, std::size_t s) const {
    return structure[(i * momenta.size() + j) * momenta.size() + s];
  }
  /// v^s(f), at fixed momenta and velocities.
  GiNaC::ex along(std::size_t s, const GiNaC::ex& f) const;
  /// The components of [v^i, v^j].
  std::vector<GiNaC::ex> commutator(std::size_t i, std::size_t j) const;
};

/// Reads the fields and finds their structure functions c_ij^s.
/// \param variables  all variables of the case, coordinates and momenta among them.
/// \throws CaseError  for an unknown or missing component, or where the commutators are no
///                    combinations of the fields, or of dependent fields in more than one way.
Frame make_frame(const VectorFieldsText& text, const std::vector<GiNaC::symbol>& variables,
                 const std::vector<GiNaC::symbol>& parameters, Scope& names);

/// The bracket (1.25): {q_i, q_j} = 0, {q_i, M_j} = v^j_i, {M_i, M_j} = - sum_s c_ij^s M_s.
/// Multiplied by `sign`.
PoissonStructure frame_bracket(const Frame& frame, const std::vector<GiNaC::symbol>& variables,
                               int sign);

/// The Legendre transform of a Lagrangian that is quadratic in the velocities: the Hamiltonian.
/// \throws CaseError  where it is not quadratic, or degenerate; `text` is the Lagrangian's.
GiNaC::ex legendre_transform(const Frame& frame, const Text& text);

}  // namespace casimir
