#pragma once

namespace casimir {

/// A header of this library kept as text; `name` is what an #include says.
struct KernelText {
  const char* name;
  const char* text;
};

/// The interface header and every file of `runtime/kernels`, embedded at build time.
extern const KernelText kKernelTexts[];
extern const int kKernelTextCount;

}  // namespace casimir
