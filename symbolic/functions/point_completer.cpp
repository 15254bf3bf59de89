#include "symbolic/functions/point_completer.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <tuple>

#include "symbolic/functions/convert/elliptic_generators.hpp"

namespace casimir::functions {

/// p = factor * symbol, if it is that.
std::optional<std::pair<std::size_t, cln::cl_RA>> PointCompleter::plain_symbol(
    const Polynomial& p) const {
  const auto terms = p.term_list();
  if (terms.size() != 1) return std::nullopt;
  std::optional<std::size_t> symbol;
  for (std::size_t i = 0; i < terms[0].second.size(); ++i) {
    if (terms[0].second[i] == 0) continue;
    if (symbol || terms[0].second[i] > 1 || i >= table_.symbols().size()) return std::nullopt;
    symbol = i;
  }
  if (!symbol) return std::nullopt;
  return std::pair(*symbol, terms[0].first);
}

std::vector<bool> PointCompleter::bare_symbols(const Polynomial& p) const {
  std::vector<bool> bare(table_.symbols().size());
  const auto mark = [&](const Polynomial& f) {
    for (std::size_t i = 0; i < table_.symbols().size(); ++i) bare[i] = bare[i] || f.uses(i);
  };
  mark(p);
  for (const Generator& g : table_.generators()) {
    const bool argument = g.kind == Kind::sine || g.kind == Kind::exponential;
    if (!argument || !plain_symbol(g.base)) mark(g.base);
  }
  return bare;
}

long PointCompleter::argument_degree() const {
  long degree = 0;
  for (const Generator& g : table_.generators()) degree = std::max(degree, g.base.total_degree());
  return degree;
}

bool PointCompleter::has_value(const Polynomial& p) const {
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    const bool valueless = table_.generators()[g].kind == Kind::function ||
                           table_.generators()[g].kind == Kind::imaginary;
    if (valueless && p.uses(table_.place(g))) return false;
  }
  return true;
}

/// The value of a sine with its cosine, or of an exponential.
bool PointCompleter::complete_argument(std::size_t g, std::vector<cln::cl_RA>& point,
                                       std::vector<bool>& chosen,
                                       const std::function<cln::cl_RA()>& draw,
                                       const Freedom& freedom) const {
  // An amplitude has no rational value, and those of different arguments may depend on each other.
  for (std::size_t i = 0; i < g; ++i)
    if (table_.generators()[i].kind == Kind::function &&
        table_.generators()[i].order >= kFirstElliptic &&
        table_.generators()[g].base.uses(table_.place(i)))
      return false;
  const bool angle = table_.generators()[g].kind == Kind::sine;
  const auto plain = plain_symbol(table_.generators()[g].base);
  cln::cl_RA t = 0;  // tan of half the angle, or the exponential less 1
  if (freedom.formal || (plain && !freedom.bare[plain->first])) {
    // A symbol whose sine and whose exponential both occur has no rational value of both.
    if (plain && chosen[plain->first] && !freedom.formal) return false;
    if (plain) chosen[plain->first] = true;
    const auto given = freedom.angles.find(table_.place(g));
    if (given != freedom.angles.end()) {
      std::tie(point[table_.place(g)], point[table_.place(g) + 1]) = given->second;
      return true;
    }
    t = draw();
    if (!angle) t = cln::abs(t) + cln::cl_RA(1) / 2 - 1;
  } else if (!cln::zerop(table_.generators()[g].base.evaluate(point))) {
    return false;
  }
  const std::size_t place = table_.place(g);
  point[place] = angle ? 2 * t / (1 + t * t) : 1 + t;
  if (angle) point[place + 1] = (1 - t * t) / (1 + t * t);
  return true;
}

std::vector<std::size_t> PointCompleter::free_sines(const Freedom& freedom) const {
  std::vector<std::size_t> places;
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    if (table_.generators()[g].kind != Kind::sine) continue;
    const auto plain = plain_symbol(table_.generators()[g].base);
    if (plain && (freedom.formal || !freedom.bare[plain->first])) places.push_back(table_.place(g));
  }
  return places;
}

bool PointCompleter::complete(std::vector<cln::cl_RA>& point,
                              const std::function<cln::cl_RA()>& draw,
                              const Freedom& freedom) const {
  point.resize(table_.ring().size(), 0);
  std::vector<bool> chosen(table_.symbols().size());
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    const Generator& generator = table_.generators()[g];
    cln::cl_RA& value = point[table_.place(g)];
    switch (generator.kind) {
      case Kind::sine:
      case Kind::exponential:
        if (!complete_argument(g, point, chosen, draw, freedom)) return false;
        break;
      case Kind::cosine:
        break;
      case Kind::function:
      case Kind::imaginary:
        break;  // no rational value: see has_value
      case Kind::inverse: {
        if (!has_value(generator.base)) return false;
        const cln::cl_RA d = generator.base.evaluate(point);
        if (cln::zerop(d)) return false;
        value = 1 / d;
        break;
      }
      case Kind::root:
      case Kind::absolute: {
        if (!has_value(generator.base)) return false;
        const cln::cl_RA b = generator.base.evaluate(point);
        if (cln::minusp(b)) return false;
        if (!cln::rootp(b, static_cast<unsigned>(generator.order), &value)) return false;
        break;
      }
    }
  }
  return true;
}

std::vector<PointCompleter::PlainArgument> PointCompleter::plain_arguments(
    const std::vector<cln::cl_RA>& point) const {
  std::vector<PlainArgument> result;
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    const bool angle = table_.generators()[g].kind == Kind::sine;
    if (!angle && table_.generators()[g].kind != Kind::exponential) continue;
    const auto plain = plain_symbol(table_.generators()[g].base);
    if (!plain) continue;
    const std::size_t place = table_.place(g);
    result.push_back({plain->first, plain->second, angle, angle ? point[place] : 0,
                      angle ? point[place + 1] : 1, angle ? 1 : point[place]});
  }
  return result;
}

}  // namespace casimir::functions
