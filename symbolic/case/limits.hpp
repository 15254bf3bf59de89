#pragma once

#include <string>
#include <vector>

namespace casimir {

/// How large what a case file asks for may become. Whatever exceeds a limit is refused with an
/// error that names it, or left undecided; nothing is cut off silently.
///
/// Limits are a value, and there are none of the process: whoever reads a case says which hold for
/// it (`read_case`, `parse_case`), the `CaseFile` and the `Model` made of it carry them, and what
/// computes with a model takes them from there. Two users of one process, in turns or in two
/// threads, do not see each other's. Functions below that level take them as an argument without a
/// default, so that the compiler says where they were forgotten.
///
/// No option of a program is named here: the words that tell people how to raise a limit are data
/// of the object and come from whoever made it. They end up inside of longer texts, as the reason
/// of a proof; `TooLarge`, `CaseError` and `Proof` say beside their text which limit it was.
struct Limits {
  double file_bytes = 16.0 * 1024 * 1024;
  double variables = 200;
  double parameters = 1000;
  double scenes = 1000;
  double claims = 1000;
  double nesting = 200;
  double depth = 1000;
  double degree = 1e4;
  double bits = 1e5;
  double size = 4e6;
  double terms = 1e6;
  double repetitions = 1e5;
  double work = 1e9;

  /// How whoever sets the limits lets others raise one: `{}` stands for its name. In messages.
  std::string how_to_raise = "a larger limit '{}' allows more";
  /// The same for memory, or empty.
  std::string how_to_get_memory;

  /// What allows more than one of these limits, in the words of whoever set them.
  std::string hint(double Limits::*limit) const;
  /// "out of memory", and what gives more.
  std::string out_of_memory() const;
};

/// One limit, by the name that people use.
struct LimitName {
  const char* name;
  double Limits::*value;
  const char* meaning;
  double most;  ///< more is not for asking: the stack would overflow
};

/// All of them.
const std::vector<LimitName>& limit_names();

/// The name of a limit; empty for a null pointer.
std::string name_of(double Limits::*limit);

/// While it lives, `spend` counts products of terms in this thread, and throws TooLarge beyond the
/// limit `work`. Without one, nothing is counted. An inner one counts on its own.
///
/// Which meter counts is the thread's own, since a product of polynomials does not know whose work
/// it is; how much it allows is said where the meter is made, and nobody else can change that.
class WorkMeter {
 public:
  /// Begins to count. \param limits  copied
  explicit WorkMeter(Limits limits);
  ~WorkMeter();
  WorkMeter(const WorkMeter&) = delete;
  WorkMeter& operator=(const WorkMeter&) = delete;

  /// Adds to what the innermost meter of this thread has counted.
  /// \throws TooLarge  beyond its limit
  static void spend(double products);

 private:
  Limits limits_;
  double done_ = 0;
  WorkMeter* outer_;
};

}  // namespace casimir
