#pragma once

#include <CLI/CLI.hpp>

namespace casimir::tools {

/// Checks that an option is a decimal number above zero, in words that say so.
CLI::Validator positive_number();

/// The same of a number that may be zero.
CLI::Validator number_from_zero();

/// The same of a whole number from 1 on.
CLI::Validator count_from_one();

}  // namespace casimir::tools
