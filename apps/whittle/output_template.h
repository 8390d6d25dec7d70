// Names of outputs that say of which input they are: -o '{name}.png'.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace whittle {

/// What a template's words stand for in one output. Those that are not set make no sense there.
struct TemplateWords {
  std::string name;                   ///< {name}
  std::optional<std::string> n{};     ///< {n}
  std::optional<std::string> view{};  ///< {view}
};

/// The output that a template names; `{{` stands for a brace. A kUsage error for words that there
/// are not, or that make no sense.
Result<std::string> fill_template(std::string_view pattern, const TemplateWords& words);

/// Whether a template has this word, as in "name".
bool has_word(std::string_view pattern, std::string_view word);

/// What {name} stands for: the input's name without folders and without its last ending; `stdin`
/// for "-".
std::string template_name(const std::string& input);

/// An output, and the option that names it.
struct OutputTemplate {
  const char* option;
  std::string pattern;
  bool has_frames;  ///< there is one of each frame
  bool has_views;   ///< there may be one of each view
};

/// A kUsage error if a template has a mistake, if several files would be written to one, or if an
/// output is one of several files that are read. `moves`: there are frames; `has_views`: views have
/// names.
Status check_templates(const std::vector<std::string>& files,
                       const std::vector<OutputTemplate>& templates, bool moves, bool has_views);

}  // namespace whittle
