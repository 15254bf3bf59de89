#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/analysis/horseshoe/covering.hpp"
#include "tools/analysis/horseshoe/entropy.hpp"
#include "tools/analysis/horseshoe/section_system.hpp"

namespace casimir {

/// Chaos as a theorem, or why there is none.
///
/// Theorem. Let N_1, .., N_m be disjoint h-sets on the surface and the level, P the first return
/// map, and let N_i => N_j (see covering.hpp) for the arrows of a graph in which every node leads
/// to every node. Then
///   (a) for every cyclic path of the graph there is a periodic point of P that visits the N_i in
///       this order (Zgliczynski & Gidea, J. Differential Equations 202 (2004) 32, theorem 9), and
///       for every path without ends an orbit of P that does so (compactness);
///   (b) the set I of the points with such orbits is compact and P-invariant, and the itinerary
///   maps
///       it continuously onto the subshift of the graph, since the N_i are disjoint: so the
///       topological entropy of P on I is at least the logarithm of the spectral radius;
///   (c) where that is positive, a function that is real-analytic on a connected neighbourhood, in
///       the level, of the orbits from the N_i to their returns, and constant along solutions, is
///       constant.
/// Proof of (c). P is injective, as the first return to a transversal. Let F be such a function,
/// not constant; then it is constant on no open part of the neighbourhood. By Bowen (Trans. Amer.
/// Math. Soc. 153 (1971) 401, theorem 17) for the factor F: I -> R, on which P acts as the
/// identity, the entropy of P on I is at most the supremum of those on the sets I_c = {x in I: F(x)
/// = c}. The level curve F = c on the surface is an analytic set of dimension one, so that a
/// compact neighbourhood K of I_c in it is a finite graph, of edges shorter than any e > 0, between
/// finitely many points E that contain its ends. P maps the curve into itself and is injective: so
/// P^-k(E) has at most as many points as E, and K without E, P^-1(E), .., P^-n(E) has at most
/// const * n parts. Two points of I_c in one part stay nearer than e for n returns. So n returns
/// are told apart, to e, by at most const * n points: the entropy on each I_c is zero, and that on
/// I is.
///
/// Hypotheses and where they are checked: that the level is regular, the sets are on it and the
/// surface is transversal: `SurfaceChart` and `SectionReturn`; that P is the first return and is
/// defined on the sets: `SectionReturn`; coverings: `Coverings`; disjointness: `SurfaceChart`; the
/// graph and its spectral radius: entropy.hpp. That the functions of the level are constant along
/// solutions: `section_system` by the prover.
struct Horseshoe {
  bool proved = false;
  std::string reason;  ///< where not: how far the search came
  horseshoe::SectionSystem system;
  std::vector<horseshoe::HSet> sets;
  horseshoe::Arrows coverings;  ///< each proved
  cln::cl_RA radius = 1;        ///< the spectral radius is not below it
  cln::cl_RA entropy = 0;       ///< nor is the entropy of the return map below this
  std::size_t parts = 0;        ///< sets whose images were enclosed for it
  std::size_t cycles = 0;       ///< hyperbolic ones that were found
  std::size_t connections = 0;  ///< orbits between them
  std::size_t attempts = 0;     ///< sets of h-sets that were tried
};

/// What is asked of `find_horseshoe`.
struct HorseshoeOptions {
  SectionRequest request = {};         ///< plane and level
  std::size_t longest_cycle = 2;       ///< that h-sets are put around
  std::function<bool()> give_up = {};  ///< asked now and then; true ends it
  std::function<void(const std::string& stage, double share)> progress = {};
  horseshoe::CoveringSettings covering = {};
};

/// Looks for hyperbolic cycles and orbits that lead from one back to it, or between two both ways,
/// in doubles, puts h-sets along these, and proves that they cover one another.
/// \throws RequestError  as `section_system`.
Horseshoe find_horseshoe(const Model& model, const Scene& scene,
                         const HorseshoeOptions& options = {});

}  // namespace casimir
