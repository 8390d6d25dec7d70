#include "show_window.h"

#include "viewer.h"
#include "whittle/export_format.h"

namespace whittle {
namespace {

/// Options that say something of files.
Status check_without_output(const RenderArguments& a) {
  const char* option = nullptr;
  if (a.openscad.animation.frames > 0) option = "--animate";
  if (a.openscad.dependency_file) option = "-d";
  if (a.summary.is_wanted()) option = "--summary";
  if (a.loading.section.is_wanted()) option = "--section";
  if (a.loading.section.explode) option = "--explode";
  if (a.xray) option = "--xray";
  if (a.renderer.ghosts) option = "--ghosts";
  if (option == nullptr) return Done{};
  return Error{ErrorKind::kUsage,
               std::string(option) + " is for files that are made; give -o FILE"};
}

}  // namespace

Result<int> show_window(const RenderArguments& a, Arguments arguments) {
  if (Status possible = check_without_output(a); !possible) return possible.error();
  if (Status possible = check_shadows(a.shading); !possible) return possible.error();
  if (Status possible = check_view(a.view); !possible) return possible.error();
  Viewer viewer(a, arguments);
  Result<int> code = viewer.run();
  if (code) return code;
  return Error{code.error().kind,
               code.error().message + "; give -o FILE, which may end in " + export_endings()};
}

}  // namespace whittle
