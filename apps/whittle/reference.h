// --reference: does a picture still look as it did?
#pragma once

#include <optional>
#include <string>

#include "base/result.h"
#include "image/picture.h"
#include "option_group.h"
#include "trace/frame.h"

namespace whittle {

struct ReferenceArguments {
  std::optional<std::string> file;        ///< a .png, or an .exr with the facts
  double threshold = 0;                   ///< the share of pixels that may differ
  std::optional<std::string> difference;  ///< the file of the difference picture

  /// Whether the colours are compared.
  bool wants_picture() const;
};
void add_reference_options(CLI::App& app, ReferenceArguments& reference);

/// A kUsage error if options do not go together, or the reference is of another kind.
Status check_reference(const ReferenceArguments& reference);

/// Compares a picture, or its facts, and writes the difference picture if one is wanted. A kInput
/// error that says how they differ if too much does. `name` is what was drawn; with_alpha: as the
/// picture would be written.
Status compare_with_reference(const ReferenceArguments& reference, const std::string& name,
                              const Frame& frame, const Picture& picture, bool with_alpha);

}  // namespace whittle
