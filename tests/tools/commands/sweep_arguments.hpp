#pragma once

#include <string>
#include <vector>

namespace casimir::test {

inline std::vector<std::string> sweep_arguments(const std::string& points,
                                                const std::string& output,
                                                const std::string& duration = "20") {
  return {"sweep",    "kovalevskaya", "--over",     "r=1/2:3/2:" + points,
          "--over",   "M3=-1:1:7",    "--duration", duration,
          "--output", output,         "--quiet"};
}

}  // namespace casimir::test
