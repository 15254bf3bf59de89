#pragma once

#include <cln/float.h>

#include <string>
#include <vector>

namespace casimir::tools {

/// A number with that many significant digits, in the style of printf's %g.
std::string decimal_text(const cln::cl_F& value, int digits);

/// The digits of `value` in which another run agrees, at most `most`; "0" if there are none.
std::string sure_text(const cln::cl_F& value, const cln::cl_F& check, int most);

/// The same of many numbers.
/// \param check  null: nothing checks them, and all have `most` digits
std::vector<std::string> sure_texts(const std::vector<cln::cl_F>& values,
                                    const std::vector<cln::cl_F>* check, int most);

}  // namespace casimir::tools
