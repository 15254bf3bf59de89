#pragma once

#include <set>
#include <string>
#include <vector>

namespace casimir::codegen {

/// Names of functions that common headers declare, which no namespace may have.
std::vector<std::string> global_functions();

/// Hands out C++ identifiers that clash with nothing: not with keywords, macros of the standard
/// headers, names that generated code uses itself, nor with each other.
class Names {
 public:
  /// \param taken  names that the surrounding code uses.
  explicit Names(std::vector<std::string> taken = {});

  /// `wanted`, made an identifier, with an underscore or a number behind it where it clashes.
  /// Depends on the calls before it only.
  std::string unique(const std::string& wanted);

 private:
  std::set<std::string> taken_;
};

/// Throws ModelError unless the code of a header may have this name: an identifier that C++ does
/// not reserve, no keyword, and nothing that Names keeps clear of.
/// \param of_namespace  and no function that common headers declare; else names begin with it
void check_header_name(const std::string& name, bool of_namespace = true);

/// Text of a stranger made fit for a `//` comment: printable ASCII on one line, without anything
/// that ends or continues a comment.
std::string comment_text(const std::string& text);

/// A C++ string literal with the quotes, whatever the text is.
std::string string_literal(const std::string& text);

}  // namespace casimir::codegen
