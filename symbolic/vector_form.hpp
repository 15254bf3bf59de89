#pragma once

#include <ginac/ginac.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/poisson.hpp"

namespace casimir {

/// Three names that differ in a last 1, 2, 3 (or x, y, z), as M1, M2, M3: the vector M.
struct Triple {
  std::string name;                    ///< what the three have in common, without a last '_'
  std::array<std::size_t, 3> indices;  ///< of the three names
};

/// The triples among `names`, in the order of their first members. J12, J13, .. are none, and
/// neither are p1, .., p4: those are the entries of matrices and vectors of other dimensions.
std::vector<Triple> find_triples(const std::vector<std::string>& names);

/// Coordinates that are taken together: a vector of R^3 (three) or a scalar (one).
struct Block {
  std::string name;
  std::vector<std::size_t> coordinates;  ///< their indices
  /// Of three coordinates.
  bool is_vector() const { return coordinates.size() == 3; }
};

/// coefficient * block, a term of a vector such as -M or x*M + y*g.
struct BlockTerm {
  GiNaC::ex coefficient;
  std::size_t block;
};

/// What the brackets between two blocks are, by the kind of the blocks:
///   {A_i, B_j} = eps_ijk v_k + delta_ij s    for vectors A and B
///   {A_i, t} = v_i                           for a vector and a scalar
///   {t, u} = s                               for scalars
struct BlockBracket {
  std::size_t a, b;          ///< a <= b: a vector comes before a scalar
  std::vector<BlockTerm> v;  ///< the vector is the sum of these
  GiNaC::ex s;
  /// Whether the blocks commute.
  bool is_zero() const { return v.empty() && s.is_zero(); }
};

/// A term of an equation of motion, where dH/dB is the gradient of H in the block B. With a block
/// `left` = C: coefficient * C x dH/dB for the motion of a vector and a vector B; coefficient *
/// (C, dH/dB) for that of a scalar; coefficient * (dH/dB) * C for a scalar B. Without:
/// coefficient * dH/dB.
struct FlowTerm {
  GiNaC::ex coefficient;
  std::optional<std::size_t> left;
  std::size_t gradient;
};

/// A bracket in the shorthand of vectors, {M_i, g_j} = -eps_ijk g_k, and what follows from it for
/// the equations of motion, dM/dt = M x dH/dM + g x dH/dg.
struct VectorForm {
  std::vector<Block> blocks;           ///< vectors first; together they hold every coordinate once
  std::vector<BlockBracket> brackets;  ///< of all pairs a <= b; zeros are among them
  std::vector<std::vector<FlowTerm>> flows;  ///< one for each block: d(block)/dt is the sum

  /// Equation by equation, with the cross products multiplied out: what `flows` say of the
  /// Hamiltonian h. One entry for each coordinate, in their order; not expanded.
  std::vector<GiNaC::ex> flow(const std::vector<GiNaC::symbol>& coordinates,
                              const GiNaC::ex& h) const;
};

/// The vector form of a bracket, or none where no triple of variables behaves as a vector. A triple
/// does if all its brackets have the shape that BlockBracket describes, with coefficients that no
/// vector occurs in, and one of them has an eps_ijk; the components of the others are scalars.
std::optional<VectorForm> find_vector_form(const PoissonStructure& structure);

/// Whether `form.flow` is `field`, identically. Both are multiplied out and compared: this does not
/// rely on how the form was found.
bool reproduces(const VectorForm& form, const std::vector<GiNaC::symbol>& coordinates,
                const GiNaC::ex& h, const std::vector<GiNaC::ex>& field);

}  // namespace casimir
