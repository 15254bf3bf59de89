#pragma once

namespace casimir::tools {

/// Opens those of the descriptors 0, 1 and 2 that the caller has closed, so that no file of ours
/// gets their numbers and with it what is printed. Writing to a stream that was closed still fails.
void open_standard_streams();

/// Writes out what is left for standard output.
/// \return why not all that was printed has arrived, or null
const char* standard_output_problem();

}  // namespace casimir::tools
