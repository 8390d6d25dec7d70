// Options that show what is inside of a solid, for all that is made of it.
#pragma once

#include <optional>
#include <vector>

#include "base/result.h"
#include "model/model.h"
#include "model/section.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has named it
class App;
}

namespace whittle {

struct SectionArguments {
  std::vector<Section> sections;
  std::vector<Rgba> kept;         ///< colours that stay whole
  std::optional<double> explode;  ///< how far the parts are moved apart, before anything is cut

  bool is_wanted() const { return !sections.empty(); }
};

/// --section, --section-keep and --explode.
void add_section_options(CLI::App& app, SectionArguments& section);

/// Moves the model's parts apart and cuts it, if that is asked for.
Status open_if_asked(const SectionArguments& section, Model& model);

}  // namespace whittle
