#include "symbolic/discrete/confinement.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "symbolic/discrete/plane_factors.hpp"
#include "symbolic/discrete/series_map.hpp"
#include "symbolic/discrete/univariate.hpp"

namespace casimir::discrete {
namespace {

constexpr int kMostSteps = 12;
constexpr std::size_t kFewPoints = 32;

/// Whether a series has no pole in eps.
bool is_finite(const Series& s, long shift = 0) {
  if (s.is_zero() || s.valuation + shift >= 0) return true;
  if (s.terms.empty()) throw TooFewTerms();
  return false;
}

/// The order of a series that is not zero.
long order(const Series& s) {
  if (s.terms.empty()) throw TooFewTerms();
  return s.valuation;
}

/// An orbit beside a singular point, and the Jacobian matrix of the iterate.
class Follower {
 public:
  Follower(const SeriesMap& map, const SeriesField& field, std::vector<Series> start)
      : map_(map), field_(field), point_(std::move(start)) {
    const std::size_t n = point_.size();
    for (std::size_t i = 0; i < n; ++i) {
      jacobian_.emplace_back(n);
      jacobian_[i][i] = field_.constant(1);
    }
  }

  /// One more iterate. False where it has no value.
  bool step() {
    const auto image = map_(point_, field_);
    if (!image) return false;
    SeriesField::Rows own = image->jacobian;
    const Series determinant = field_.eliminate(own);
    if (determinant.is_zero()) return false;
    order_ += order(determinant);
    jacobian_ = product(image->jacobian, jacobian_);
    point_ = image->point;
    return true;
  }

  /// Whether the orders in eps are so large that the next ones would not fit a word.
  bool is_far() const {
    constexpr long kFar = 1'000'000'000'000;
    return std::ranges::any_of(point_, [](const Series& x) {
      return !x.is_zero() && (x.valuation > kFar || x.valuation < -kFar);
    });
  }

  /// See `confinement_of`: d(1/x) = -dx/x^2.
  bool is_regular() const {
    long order = order_;
    bool finite = true;
    for (std::size_t i = 0; i < point_.size(); ++i) {
      const long shift = is_finite(point_[i]) ? 0 : -2 * point_[i].valuation;
      order += shift;
      for (const Series& entry : jacobian_[i]) finite = is_finite(entry, shift) && finite;
    }
    return finite && order == 0;
  }

 private:
  SeriesField::Rows product(const SeriesField::Rows& a, const SeriesField::Rows& b) const {
    SeriesField::Rows result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < a.size(); ++j) {
        Series sum;
        for (std::size_t k = 0; k < a.size(); ++k)
          sum = field_.add(sum, field_.multiply(a[i][k], b[k][j]));
        result[i].push_back(std::move(sum));
      }
    }
    return result;
  }

  const SeriesMap& map_;
  const SeriesField& field_;
  std::vector<Series> point_;
  SeriesField::Rows jacobian_;
  long order_ = 0;  ///< of its determinant
};

/// A line x0 + t v of the space.
struct RandomLine {
  std::vector<Element> origin, direction;

  std::vector<Series> near(Element t, const SeriesField& field) const {
    const PrimeField residues(kSplittingPrime);
    std::vector<Series> point;
    for (std::size_t i = 0; i < origin.size(); ++i)
      point.push_back(
          field.line(residues.add(origin[i], residues.multiply(t, direction[i])), direction[i]));
    return point;
  }
};

/// What an orbit beside a point loses and recovers; empty where it ends.
std::optional<SingularOrbit> followed(const SeriesMap& map, const SeriesField& field,
                                      const RandomLine& line, Element t) {
  Follower orbit(map, field, line.near(t, field));
  SingularOrbit found;
  while (found.until < kMostSteps && !orbit.is_far()) {
    if (!orbit.step()) return std::nullopt;
    ++found.until;
    const bool regular = orbit.is_regular();
    if (!regular && found.lost == 0) found.lost = found.until;
    if (regular && found.lost > 0) {
      found.recovered = found.until;
      break;
    }
  }
  return found;
}

/// The same with as many terms as it needs; empty where those are too many.
std::optional<SingularOrbit> followed(const SeriesMap& map, const RandomLine& line, Element t) {
  constexpr std::size_t kFirstTerms = 12, kMostTerms = 100;
  for (std::size_t terms = kFirstTerms; terms < kMostTerms; terms *= 2) {
    try {
      return followed(map, SeriesField(terms), line, t);
    } catch (const TooFewTerms&) {
      continue;
    }
  }
  return std::nullopt;
}

/// Where on a line the Jacobian determinant has zeros or poles, or the map poles.
struct SingularPlaces {
  std::set<Element> places;
  /// The numerator and the denominator of the determinant, and the common one of the coordinates.
  std::vector<Univariate> polynomials;
  std::size_t points = 0;  ///< that they were found from
};

void add_zeros(SingularPlaces& found, const Univariate& polynomial) {
  found.polynomials.push_back(polynomial);
  if (polynomial.degree() <= 0) return;
  const std::vector<Element> zeros = polynomial.zeros();
  found.places.insert(zeros.begin(), zeros.end());
}

/// The image of a point of the field and the determinant there; empty where there is none. A number
/// whose one term cancels is zero.
std::optional<std::pair<std::vector<Element>, Element>> image_of(const SeriesMap& map,
                                                                 const std::vector<Series>& point) {
  const SeriesField constants(1);
  const auto value = [](const Series& s) { return s.terms.empty() ? Element{0} : s.terms[0]; };
  std::optional<SeriesMap::Image> image;
  try {
    image = map(point, constants);
  } catch (const TooFewTerms&) {
    return std::nullopt;
  }
  if (!image) return std::nullopt;
  std::pair<std::vector<Element>, Element> result;
  for (const Series& x : image->point) result.first.push_back(value(x));
  try {
    result.second = value(constants.eliminate(image->jacobian));
  } catch (const TooFewTerms&) {
    result.second = 0;
  }
  return result;
}

/// Empty where the degrees are too large, and for a map that is invertible nowhere.
/// \param first  how many points are tried at first
std::optional<SingularPlaces> places_on(const SeriesMap& map, const RandomLine& line,
                                        const search::Watch& watch,
                                        std::size_t first = kFewPoints) {
  constexpr std::size_t kMostPoints = 4096;
  const SeriesField constants(1);
  const PrimeField residues(kSplittingPrime);
  const std::vector<Element> weights = map.random_point();
  std::vector<Element> t, determinants, sums;
  Element next = 1;
  for (std::size_t points = first; points <= kMostPoints; points *= 2) {
    for (; t.size() < points && next < 2 * kMostPoints; ++next) {
      if (next % 16 == 0) watch.tick(static_cast<double>(t.size()) / static_cast<double>(points));
      std::vector<Series> point;
      for (std::size_t i = 0; i < line.origin.size(); ++i)
        point.push_back(constants.constant(
            residues.add(line.origin[i], residues.multiply(next, line.direction[i]))));
      const auto image = image_of(map, point);
      if (!image) continue;
      Element sum = 0;
      for (std::size_t i = 0; i < weights.size(); ++i)
        sum = residues.add(sum, residues.multiply(weights[i], image->first[i]));
      t.push_back(next);
      sums.push_back(sum);
      determinants.push_back(image->second);
    }
    const auto determinant = quotient_from_values(t, determinants, kSplittingPrime);
    const auto coordinate = quotient_from_values(t, sums, kSplittingPrime);
    if (!determinant || !coordinate) continue;
    if (determinant->top.is_zero()) return std::nullopt;
    SingularPlaces found;
    found.points = points;
    add_zeros(found, determinant->top);
    add_zeros(found, determinant->bottom);
    add_zeros(found, coordinate->bottom);
    return found;
  }
  return std::nullopt;
}

/// Whether points of all hypersurfaces were looked at, and recovered what they had lost: those of
/// the field on a few lines need not lie on each, as y^2 = 17 has none where 17 is no square.
///
/// Over the field the equation of a hypersurface that is irreducible over the rational functions of
/// the parameters has irreducible factors, which are conjugate, so that all do what one does. One
/// without points has none with points for any parameters: its degree is a sum of degrees of such
/// factors each time. Where no number is, points of all were seen.
class HypersurfaceAudit {
 public:
  HypersurfaceAudit(SeriesMap map, const search::Watch& watch)
      : map_(std::move(map)), watch_(watch) {}

  bool is_passed() {
    constexpr int kTrials = 12;
    watch_.begin("hypersurfaces");
    for (int k = 0; k < kTrials; ++k) {
      watch_.tick(static_cast<double>(k) / kTrials);
      map_.choose_parameters();
      const std::optional<Unseen> unseen = unseen_on_plane();
      if (!unseen) return false;
      if (k == 0) {
        never_seen_ = *unseen;
      } else {
        for (auto& [key, degrees] : never_seen_) {
          const auto now = unseen->find(key);
          if (now == unseen->end())
            degrees.clear();
          else
            std::erase_if(degrees, [&](long d) { return !now->second.contains(d); });
        }
      }
      if (std::ranges::all_of(never_seen_, [](const auto& own) { return own.second.empty(); }))
        return true;
    }
    return false;
  }

 private:
  /// Sums of degrees of factors without points, by the polynomial and the power that they have in
  /// it.
  using Unseen = std::map<std::pair<std::size_t, unsigned long>, std::set<long>>;

  struct LineOfPlane {
    Element slope;
    RandomLine line;
    SingularPlaces singular;
  };

  std::optional<LineOfPlane> line_with(Element slope, std::size_t points) const {
    const PrimeField field(kSplittingPrime);
    RandomLine line{origin_, first_};
    for (std::size_t i = 0; i < first_.size(); ++i)
      line.direction[i] = field.add(first_[i], field.multiply(slope, second_[i]));
    std::optional<SingularPlaces> singular = places_on(map_, line, watch_, points);
    if (!singular) return std::nullopt;
    return LineOfPlane{slope, std::move(line), std::move(*singular)};
  }

  /// Empty where something was not recovered, or not followed.
  std::optional<Unseen> unseen_on_plane() {
    origin_ = map_.random_point();
    first_ = map_.random_point();
    second_ = map_.random_point();
    const auto lines = lines_of_plane();
    if (!lines) return std::nullopt;
    Unseen unseen;
    for (std::size_t k = 0; k < lines->front().singular.polynomials.size(); ++k) {
      std::vector<OnLine> one;
      for (const LineOfPlane& own : *lines) one.push_back({own.slope, own.singular.polynomials[k]});
      const auto factors = PlaneFactors::from_lines(one, kSplittingPrime);
      if (!factors) return std::nullopt;
      for (std::size_t f = 0; f < factors->size(); ++f) {
        const std::optional<bool> good = recovers(*factors, f, *lines);
        if (good == false) return std::nullopt;
        if (!good) add(unseen[{k, factors->exponent(f)}], factors->degree(f));
      }
    }
    return unseen;
  }

  static void add(std::set<long>& sums, long degree) {
    std::set<long> with{degree};
    for (const long sum : sums) with.insert(sum + degree);
    sums.merge(with);
  }

  /// More than the degrees: an irreducible curve misses a line with the probability 1/2 at most.
  std::optional<std::vector<LineOfPlane>> lines_of_plane() const {
    constexpr long kHighestDegree = 100;
    constexpr std::size_t kMoreLines = 16;
    std::vector<LineOfPlane> lines;
    std::size_t wanted = kMoreLines;
    while (lines.size() < wanted) {
      std::optional<LineOfPlane> next =
          line_with(lines.size() + 1, lines.empty() ? kFewPoints : lines.back().singular.points);
      if (!next) return std::nullopt;
      for (const Univariate& p : next->singular.polynomials) {
        if (p.degree() > kHighestDegree) return std::nullopt;
        wanted = std::max(wanted, static_cast<std::size_t>(p.degree()) + kMoreLines);
      }
      lines.push_back(std::move(*next));
    }
    return lines;
  }

  /// Empty where none of the lines has a point of the factor.
  std::optional<bool> recovers(const PlaneFactors& factors, std::size_t factor,
                               const std::vector<LineOfPlane>& lines) const {
    const PrimeField field(kSplittingPrime);
    for (const LineOfPlane& own : lines) {
      for (const Element t : own.singular.places) {
        if (!factors.vanishes(factor, t, field.multiply(t, own.slope))) continue;
        const std::optional<SingularOrbit> orbit = followed(map_, own.line, t);
        return orbit && (orbit->lost == 0 || orbit->recovered);
      }
    }
    return std::nullopt;
  }

  SeriesMap map_;
  const search::Watch& watch_;
  Unseen never_seen_;
  std::vector<Element> origin_, first_, second_;
};

Confinement judged(const SeriesMap& given, const search::Watch& watch) {
  constexpr int kLines = 6;
  constexpr std::size_t kMostOrbits = 40;
  SeriesMap map = given;
  Confinement result;
  result.steps = kMostSteps;
  std::map<std::array<int, 3>, int> seen;  // by `lost`, `recovered` or 0, and `until`
  std::size_t orbits = 0;
  watch.begin("singularities");
  for (int k = 0; k < kLines && orbits < kMostOrbits; ++k) {
    map.choose_parameters();
    const RandomLine line{map.random_point(), map.random_point()};
    const std::optional<SingularPlaces> found = places_on(map, line, watch);
    if (!found) return result;
    for (const Element t : found->places) {
      if (++orbits > kMostOrbits) break;
      watch.tick(static_cast<double>(k) / kLines);
      const std::optional<SingularOrbit> orbit = followed(map, line, t);
      if (!orbit) return result;
      if (orbit->lost > 0) ++seen[{orbit->lost, orbit->recovered.value_or(0), orbit->until}];
    }
  }
  result.kind = seen.empty() ? Confinement::Kind::none : Confinement::Kind::confined;
  for (const auto& [key, points] : seen) {
    const auto [lost, recovered, until] = key;
    if (recovered == 0) result.kind = Confinement::Kind::not_confined;
    result.orbits.push_back(
        {lost, recovered == 0 ? std::nullopt : std::optional(recovered), until, points});
    if (recovered == 0) result.steps = std::min(result.steps, until);
  }
  if (result.kind != Confinement::Kind::not_confined && !HypersurfaceAudit(map, watch).is_passed())
    result.kind = Confinement::Kind::unclear;
  return result;
}

}  // namespace

std::string to_string(Confinement::Kind kind) {
  switch (kind) {
    case Confinement::Kind::none:
      return "none";
    case Confinement::Kind::confined:
      return "confined";
    case Confinement::Kind::not_confined:
      return "not_confined";
    case Confinement::Kind::unclear:
      break;
  }
  return "unclear";
}

Confinement confinement_of(const MapModel& map, const search::Watch& watch) {
  return judged(SeriesMap(map), watch);
}

Confinement confinement_of_kahan(const Model& flow, const search::Watch& watch) {
  return judged(SeriesMap::kahan(flow), watch);
}

}  // namespace casimir::discrete
