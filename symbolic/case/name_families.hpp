#pragma once

#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/case_file.hpp"
#include "symbolic/expression/indices.hpp"

namespace casimir {

/// One of the names, or keys, that a text with ranges stands for, and what its letters are there.
struct FamilyMember {
  Text name;
  Indices indices;
};

/// "q[1..3]" stands for q1, q2, q3; "q[i=1..n], p[i]" for q1, p1 and so on, with i. Bounds are
/// integers, and expressions in those that are known and in the letters before. A text without '['
/// stands for itself. The order is that of counting, with the last range the fastest.
/// \param known  integers by name
/// \param limits  of the repetitions, and of the expressions of bounds
/// \throws CaseError  with its place: a bound or an index that is no integer, a bracket that is not
///                    closed, a letter that is used twice, or more members than repetitions are
///                    allowed.
std::vector<FamilyMember> members_of(const Text& text, const Indices& known, const Limits& limits);

}  // namespace casimir
