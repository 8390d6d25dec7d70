// From what was read to the files that show it.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "console.h"
#include "draw_picture.h"
#include "host/read_file.h"
#include "render_arguments.h"

namespace whittle {

/// What a run has made so far.
struct Made {
  int code = kExitDone;
  Status compared = Done{};                 ///< with --reference; everything else is still written
  std::vector<std::string> targets, files;  ///< for make
  std::set<std::string> said;  ///< what is said once, however many frames it is true of

  void add(const std::vector<Output>& outputs, const Read& read) {
    for (const Output& output : outputs) targets.push_back(output.path);
    for (const std::string& file : read.files) {
      if (std::ranges::find(files, file) == files.end()) files.push_back(file);
    }
  }
};

/// Pictures first: what is no solid to print may well be seen.
Status render_still(RenderArguments& a, const std::vector<Output>& outputs, Made& made);

/// Says what is seen and what is not in a picture, unless it was said of another.
void say_of_picture(const RenderArguments& a, const Model& model, const Drawn& drawn, Made& made);

/// The films among the outputs, for make.
void add_films(const RenderArguments& a, const std::vector<Output>& outputs, Made& made);

/// Says what --summary asks for.
Status tell_summary(const RenderArguments& a, const SummaryFacts& facts);

/// Of --animate. `outputs`: templates.
Status render_frames(RenderArguments& a, const std::vector<Output>& outputs, Made& made);

}  // namespace whittle
