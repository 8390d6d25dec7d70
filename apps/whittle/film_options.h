// --turntable and --fps: what is asked of films.
#pragma once

#include "base/result.h"
#include "option_group.h"
#include "whittle/choices.h"

namespace whittle {

struct FilmArguments {
  int turntable = 0;  ///< frames of one turn; 0: none
  double fps = 25;    ///< of films
  bool has_fps = false;
};
void add_film_options(CLI::App& app, FilmArguments& film);

/// A kUsage error for a film of that format that cannot be made.
Status check_film(const FilmArguments& film, FilmFormat format, const std::string& path,
                  bool with_alpha);

}  // namespace whittle
