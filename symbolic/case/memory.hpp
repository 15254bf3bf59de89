#pragma once

namespace casimir {

/// Makes the libraries of exact numbers throw std::bad_alloc where memory is not to be had; by
/// themselves GMP and FLINT end the process. To be called before they are used.
void throw_when_out_of_memory();

}  // namespace casimir
