#pragma once

#include <string>
#include <vector>

namespace casimir {

/// How large what a case file asks for may become. Whatever exceeds a limit is refused with an
/// error that names it, or left undecided; nothing is cut off silently.
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

/// The limits of this process: those above, unless `set_limits` was called.
const Limits& limits();

/// To be called before anything is read: the limits are not for changing while threads run.
void set_limits(const Limits& limits);

/// What allows more than a limit, in the words of whoever set the limits.
std::string limit_hint(double Limits::*limit);

/// "out of memory", and what gives more.
std::string out_of_memory();

/// While it lives, `spend` counts products of terms in this thread, and throws TooLarge beyond the
/// limit `work`. Without one, nothing is counted. An inner one counts on its own.
class WorkMeter {
 public:
  WorkMeter();
  ~WorkMeter();
  WorkMeter(const WorkMeter&) = delete;
  WorkMeter& operator=(const WorkMeter&) = delete;

  static void spend(double products);

 private:
  double done_ = 0;
  WorkMeter* outer_;
};

}  // namespace casimir
